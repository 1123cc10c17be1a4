#include "model_io/nastran.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/text_lines.hpp"
#include "model_io/deck_model.hpp"
#include "model_io/deck_units.hpp"
#include "model_io/model_toml.hpp"
#include "model_io/nastran_attachments.hpp"
#include "model_io/nastran_elements.hpp"
#include "model_io/nastran_grids.hpp"
#include "model_io/nastran_parts.hpp"
#include "model_io/nastran_stage.hpp"
#include "model_io/nastran_supports.hpp"

namespace twindeck::model_io {
namespace nastran {
namespace {

using Reader = void (*)(Parts&, const Card&);

/// Cards in the order in which they must be understood: what others refer to, elements, what sits on them, rigid links.
const std::vector<std::map<std::string, Reader>>& reading_passes() {
  static const std::vector<std::map<std::string, Reader>> passes = {
      by_word<Reader>({{index_card, {"GRID",  "GRDSET", "CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S",
                                     "MAT1",  "PBAR",   "PBARL",  "PBEAM",  "PBEAML", "PROD",   "PSHELL", "PSOLID",
                                     "PELAS", "PBUSH",  "PMASS",  "SPOINT", "BAROR",  "BEAMOR"}}}),
      by_word<Reader>({{read_member, {"CBAR", "CBEAM"}},
                       {read_rod, {"CROD", "CONROD"}},
                       {read_shell, {"CQUAD4", "CTRIA3", "CQUAD8", "CTRIA6"}},
                       {read_solid, {"CHEXA", "CTETRA"}}}),
      by_word<Reader>({{read_scalar_spring, {"CELAS1", "CELAS2"}},
                       {read_bush, {"CBUSH"}},
                       {read_mass, {"CONM1", "CONM2"}},
                       {read_scalar_mass, {"CMASS1", "CMASS2"}},
                       {read_rigid, {"RBE2", "RBAR"}},
                       {read_average, {"RBE3"}}})};
  return passes;
}

/// Cards that change neither stiffness nor mass, with the reason ("a load"); they are counted in a note.
const std::map<std::string, std::string>& ignored_cards() {
  static const std::map<std::string, std::string> cards = by_word<std::string>(
      {{"say how modes are computed", {"EIGRL", "EIGR", "EIGB", "EIGC", "EIGP", "SUPORT", "SUPORT1"}},
       {"choose unknowns for a reduction, which is not done here",
        {"ASET", "ASET1", "OMIT", "OMIT1", "QSET", "QSET1", "USET", "USET1"}},
       {"are loads: they act on modes where STATSUB chooses their subcase",
        {"FORCE",  "FORCE1", "FORCE2", "MOMENT", "MOMENT1", "MOMENT2", "PLOAD",  "PLOAD1", "PLOAD2",
         "PLOAD4", "GRAV",   "RFORCE", "LOAD",   "LSEQ",    "DLOAD",   "SLOAD",  "SPCD",   "DAREA",
         "DELAY",  "DPHASE", "RLOAD1", "RLOAD2", "TLOAD1",  "TLOAD2",  "DEFORM", "ACCEL",  "ACCEL1"}},
       {"are random loads", {"RANDPS", "RANDT1", "TABRND1"}},
       {"are temperatures, which act on modes where STATSUB chooses them, or belong to heat",
        {"TEMP", "TEMPD", "TEMPRB", "TEMPP1", "MAT4", "MAT5", "CHBDYE", "CHBDYG", "CONV", "PCONV", "RADM", "RADBC"}},
       {"are tables of loads or damping", {"TABLED1", "TABLED2", "TABLED3", "TABLED4", "TABDMP1"}},
       {"are steps of a response", {"FREQ", "FREQ1", "FREQ2", "FREQ3", "FREQ4", "FREQ5", "TSTEP", "TSTEPNL", "NLPARM"}},
       {"are air, not structure",
        {"AERO", "AEROS", "CAERO1", "PAERO1", "SPLINE1", "SPLINE2", "MKAERO1", "MKAERO2", "FLUTTER", "FLFACT", "GUST", "TRIM",
         "AESTAT", "AESURF", "AELIST"}},
       {"are dampers: give them in springs.csv of the model folder",
        {"CDAMP1", "CDAMP2", "CDAMP3", "CDAMP4", "PDAMP", "CVISC", "PVISC"}},
       {"are control equations, which enter complex modes only", {"TF", "EPOINT"}},
       {"are lists, pictures or settings of the program", {"SET1", "SET3", "PLOTEL", "MDLPRM"}},
       {"are design variables and responses",
        {"DESVAR", "DVPREL1", "DVMREL1", "DRESP1", "DRESP2", "DCONSTR", "DCONADD", "DOPTPRM", "DLINK"}}});
  return cards;
}

/// Cards that are known and refused, with what to write instead.
const std::map<std::string, std::string>& refused_cards() {
  static const std::map<std::string, std::string> cards = by_word<std::string>(
      {{"mesh the plate with quadrilaterals (CQUAD4)", {"CTRIAR"}},
       {"a CQUADR may be written as CQUAD4", {"CQUADR"}},
       {"mesh with hexahedra of 8 nodes (CHEXA)", {"CPENTA", "CPYRAM"}},
       {"give the plate as a PSHELL of one material", {"PCOMP", "PCOMPG", "MAT2", "MAT8", "CSHEAR"}},
       {"give an isotropic material by MAT1", {"MAT3", "MAT9", "MAT10", "MATT1"}},
       {"a rigid joint is RBE2 or RBAR", {"RBE1", "RROD", "RTRPLT", "RSPLINE", "CWELD", "CFAST"}},
       {"write a straight CBAR or CBEAM with PBAR or PBEAM", {"CBEND", "PBEND", "PBCOMP", "PBMSECT", "PBRSECT"}},
       {"write a CROD with the area of the tube", {"CTUBE", "PTUBE"}},
       {"put a GRID in place of the scalar point", {"CELAS3", "CELAS4", "CMASS3", "CMASS4"}},
       {"give the whole model as matrices (docs/my_model.md), or the element by DMIG", {"GENEL"}},
       {"give DMIG, which is chosen by K2GG and M2GG", {"DMIJ", "DMIJI", "DMIK", "DMI"}},
       {"modes need a linear joint: CELAS2 or CBUSH", {"CGAP", "CBUSH1D", "BCTABLE", "BCONTACT", "BSURF"}}});
  return cards;
}

/// PARAM names that would scale the matrices of the structure; every other parameter but WTMASS and COUPMASS is passed over.
bool scales_matrices(const std::string& parameter) {
  return contains(std::array{"CK1", "CK2", "CK3", "CM1", "CM2"}, parameter);
}

/// Read together at the end, by the sets that the case control chooses; and parameters.
bool is_read_apart(const std::string& name) {
  return contains(
      std::array{"SPC", "SPC1", "SPCADD", "MPC", "MPCADD", "PARAM", "DMIG", "NSM", "NSM1", "NSML", "NSML1", "NSMADD"}, name);
}

void refuse_or_note(Parts& parts) {
  std::vector<std::string> known;
  for (const auto& pass : reading_passes())
    for (const auto& [name, reader] : pass) known.push_back(name);
  std::map<std::string, std::pair<long, const Card*>> passed_over;
  for (const Card& card : parts.deck.cards()) {
    if (is_read_apart(card.name) || contains(known, card.name)) {
      if (!card.stray.empty())
        card.fail(fmt::format("the line '{}' below it is the continuation of another card", card.stray),
                  "put the continuations of a card below it");
    } else if (ignored_cards().contains(card.name)) {
      auto& [count, first] = passed_over.try_emplace(card.name, 0, &card).first->second;
      ++count;
    } else if (const auto hint = refused_cards().find(card.name); hint != refused_cards().end()) {
      card.fail("this card is not read", hint->second);
    } else {
      DeckPlace{card.file, card.line, card.name.substr(0, 8)}.fail(
          "unknown card" + did_you_mean(card.name, known),
          "leave it out if the model is meant without it; docs/import_nastran.md lists what is read");
    }
  }
  for (const auto& [name, entry] : passed_over)
    parts.notes.push_back(fmt::format("{} cards ({}, first in line {} of {}) are left out: they {}", name, entry.first,
                                      entry.second->line, entry.second->file->filename().string(), ignored_cards().at(name)));
}

/// What Nastran takes for K6ROT in linear analyses where the deck does not say it, and the share of G t that one unit of it is:
/// the drilling penalty over G, as in Hughes and Brezzi's form here.
constexpr double default_k6rot = 100.0, k6rot_unit = 1e-6;

/// @return  WTMASS
double read_parameters(Parts& parts) {
  double wtmass = 1.0, k6rot = default_k6rot;
  parts.model.formulation.lumped_mass = true;
  parts.model.formulation.beam_rotary_inertia = false;
  parts.model.formulation.shell_rotary_inertia = false;
  for (const Card& card : parts.deck.cards()) {
    if (card.name != "PARAM") continue;
    const std::string name = card.word(0);
    if (name == "WTMASS") wtmass = card.number(1);
    if (name == "K6ROT") k6rot = card.number(1);
    if (name == "COUPMASS") parts.model.formulation.lumped_mass = card.integer(1) <= 0;
    if (name == "WTMASS" && !(wtmass > 0.0)) card.fail("is not above 0", "give mass per weight, 1/g");
    if (name == "NMLOOP" && card.integer(1) != 0)
      card.fail("asks for modes after a nonlinear static loop, which is not read",
                "write SOL 103 with a static subcase and STATSUB");
    if (scales_matrices(name) && card.number(1) != 1.0)
      card.fail("scales the matrices of the structure, which is not read", "leave it out");
  }
  // None at all leaves the rotation to AUTOSPC; here the formulation's own penalty stands in (factor 0).
  parts.model.formulation.drilling_factor = std::max(0.0, k6rot_unit * k6rot);
  return wtmass;
}

/// Nodes in the order of their numbers, which is how people look for them.
void sort_nodes(Parts& parts) {
  std::vector<int> now(parts.model.nodes.size());
  int next = 0;
  for (auto& [grid, position] : parts.node_position) position = now[fe::slot(position)] = next++;
  renumber_nodes(parts.model, now);
  const auto used =
      std::ranges::count_if(parts.node_position, [&](const auto& node) { return parts.grids.contains(node.first); });
  if (const auto unused = std::ssize(parts.grids) - used; unused > 0)
    parts.notes.push_back(fmt::format("grids that no element, mass or link uses are left out: {}", unused));
}

}  // namespace
}  // namespace nastran

bool is_nastran_file(const std::filesystem::path& file) {
  const std::string ending = upper_case(file.extension().string());
  if (ending == ".BDF" || ending == ".NAS" || ending == ".BLK") return true;
  if (ending != ".DAT" || !std::filesystem::is_regular_file(file)) return false;
  io::TextLines stream(file, io::longest_text);
  std::string line;
  while (stream.next(line)) {
    const std::string word = upper_case(line.substr(0, 10));
    if (word.starts_with("BEGIN BULK") || word.starts_with("GRID ") || word.starts_with("GRID,") || word.starts_with("GRID*"))
      return true;
  }
  return false;
}

ImportedModel read_nastran(const std::filesystem::path& path) {
  const nastran::Deck deck = nastran::Deck::read(path);
  nastran::Parts parts(deck);
  parts.model.source = path.string();
  parts.model.title = deck.case_control().title;
  nastran::refuse_or_note(parts);
  parts.wtmass = nastran::read_parameters(parts);
  for (const auto& pass : nastran::reading_passes())
    for (const nastran::Card& card : deck.cards())
      if (const auto reader = pass.find(card.name); reader != pass.end()) reader->second(parts, card);
  nastran::read_multipoint(parts);
  nastran::read_direct_matrices(parts);
  nastran::finish_masses(parts);
  nastran::read_spread_masses(parts);
  nastran::read_supports(parts);
  nastran::finish_rods(parts);
  if (parts.model.elements.empty() && parts.model.springs.empty() && parts.model.matrix_elements.empty())
    throw InputError({path.string(), 0, ""}, "holds no element",
                     "expected CBAR, CBEAM, CROD, CQUAD4, CTRIA3, CHEXA, CELAS or CBUSH cards");
  nastran::sort_nodes(parts);
  nastran::read_stage(parts);

  auto beside = path;
  beside.replace_extension(".toml");
  UnitKeys keys;
  const std::size_t own_matrices = parts.model.matrix_elements.size();
  const bool falls = !parts.model.prestress.load_case.empty();
  const double own_gravity = parts.model.gravity_m_s2;
  if (std::filesystem::exists(beside))
    read_model_toml(beside, parts.model, [&keys](io::FieldTable& table) { keys.add_to(table); });
  // What the TOML file adds is in SI already.
  std::vector<fe::MatrixElement> added(parts.model.matrix_elements.begin() + static_cast<std::ptrdiff_t>(own_matrices),
                                       parts.model.matrix_elements.end());
  parts.model.matrix_elements.resize(own_matrices);
  const DeckUnits units = units_of(keys, beside);
  to_si(parts.model, units, parts.wtmass);
  if (falls && parts.model.gravity_m_s2 == own_gravity) parts.model.gravity_m_s2 *= units.length_m;
  parts.model.matrix_elements.insert(parts.model.matrix_elements.end(), added.begin(), added.end());
  return {std::move(parts.model), std::move(parts.notes), {deck.files().begin(), deck.files().end()}};
}

}  // namespace twindeck::model_io
