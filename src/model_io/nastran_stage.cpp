#include "model_io/nastran_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/lists.hpp"
#include "model_io/deck_stage.hpp"
#include "model_io/nastran_properties.hpp"

namespace twindeck::model_io::nastran {
namespace {

constexpr const char* write_others =
    "read are FORCE, MOMENT, FORCE1, MOMENT1, PLOAD, PLOAD1, PLOAD2, PLOAD4, GRAV, SPCD, TEMP, "
    "TEMPD, TEMPRB; write others as FORCE";

class StageReader {
 public:
  StageReader(Parts& parts, const Subcase& subcase) : parts_(parts), subcase_(subcase), stage_(parts, false, write_others) {}

  void read() {
    move_supports("SPC", parts_.deck.case_control().spc);
    if (const auto load = subcase_.chosen.find("LOAD"); load != subcase_.chosen.end()) {
      for (const auto& [set, factor] : combined(load->second)) {
        read_set(set, factor);
        move_supports("SPCD", set, factor);
      }
    }
    warm_all();
    stage_.close(fmt::format("subcase {} (STATSUB)", subcase_.id));
  }

 private:
  /// Load sets with their factors: a LOAD card's, or the one itself.
  [[nodiscard]] std::map<long, double> combined(long set) const {
    std::map<long, double> sets;
    for (const Card& card : parts_.deck.cards()) {
      if (card.name != "LOAD" || card.integer(0) != set) continue;
      for (std::size_t i = 2; i + 1 < card.size(); i += 2) sets[card.integer(i + 1)] += card.number(1) * card.number(i);
      return sets;
    }
    return {{set, 1.0}};
  }

  void read_set(long set, double factor) {
    using Handler = void (StageReader::*)(const Card&, double);
    static const std::map<std::string, Handler> handlers = {
        {"FORCE", &StageReader::read_force},     {"MOMENT", &StageReader::read_force}, {"FORCE1", &StageReader::read_force},
        {"MOMENT1", &StageReader::read_force},   {"PLOAD1", &StageReader::read_line},  {"PLOAD2", &StageReader::read_pressure},
        {"PLOAD4", &StageReader::read_pressure}, {"PLOAD", &StageReader::read_facet},  {"GRAV", &StageReader::read_gravity}};
    static const std::set<std::string> refused = {"FORCE2", "MOMENT2", "RFORCE",  "SLOAD",
                                                  "ACCEL",  "ACCEL1",  "PLOADX1", "DEFORM"};
    bool any = false;
    for (const Card& card : parts_.deck.cards()) {
      const auto handler = handlers.find(card.name);
      const bool is_refused = refused.contains(card.name), moves = card.name == "SPCD";
      if ((handler == handlers.end() && !is_refused && !moves) || card.integer(0) != set) continue;
      if (is_refused)
        card.fail("stiffens or softens the structure of the modes that STATSUB asks for, and is not read", write_others);
      if (!moves) (this->*handler->second)(card, factor);
      any = true;
    }
    if (!any)
      parts_.deck.whole("LOAD").fail(fmt::format("subcase {} chooses the loads {}, which no card has", subcase_.id, set),
                                     "give the cards, or mend the number");
  }

  /// A vector that a card counts in a coordinate system, in basic axes.
  [[nodiscard]] Eigen::Vector3d in_basic(const Card& card, long system, const Eigen::Vector3d& at, const Eigen::Vector3d& v) {
    return system == 0 ? v : Eigen::Vector3d(parts_.system(card, system).axes_at(at).transpose() * v);
  }

  void read_force(const Card& card, double factor) {
    const bool turns = card.name.starts_with("MOMENT");
    const long grid = card.integer(1);
    Eigen::Vector3d f;
    if (card.name.ends_with('1')) {
      const Eigen::Vector3d chord = parts_.grid_place(card, card.integer(4)) - parts_.grid_place(card, card.integer(3));
      f = card.number(2) * chord.normalized();
    } else {
      f = in_basic(card, card.integer_or(2, 0), parts_.grid_place(card, grid), card.number(3) * card.vector(4));
    }
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    stage_.load(stage_.node(card, grid), turns ? none : factor * f, turns ? factor * f : none);
  }

  void read_line(const Card& card, double factor) {
    // SID, EID, TYPE, SCALE, X1, P1, X2, P2
    const std::string type = card.word(2), scale = card.word(3);
    const bool local = type.size() == 3 && type[2] == 'E';
    if (type.size() < 2 || type[0] != 'F' || type[1] < 'X' || type[1] > 'Z' || (type.size() > 2 && !local))
      card.fail(fmt::format("is of type {}, of which FX, FY, FZ, FXE, FYE, FZE are read", type),
                "write it as FORCE and MOMENT of grids");
    if (scale != "LE" && scale != "FR")
      card.fail(fmt::format("has the scale {}, of which LE and FR are read", scale), "give lengths or fractions");
    stage_.load_line(card, card.integer(1), [&](const fe::Element& e) {
      const double length = (parts_.place(e.nodes[1]) - parts_.place(e.nodes[0])).norm(), per = scale == "LE" ? length : 1.0;
      const double x1 = card.number_or(4, 0.0) / per, p1 = factor * card.number(5);
      const double x2 = card.number_or(6, x1 * per) / per, p2 = factor * card.number_or(7, card.number(5));
      Eigen::Vector3d direction = Eigen::Vector3d::Unit(type[1] - 'X');
      if (local) direction = member_axes(parts_.model, e).row(type[1] - 'X').transpose();
      LineLoad load{p1 * direction, p2 * direction, x1, x2};
      if (x2 <= x1) {                   // a force at one place, as a short line of it
        constexpr double point = 1e-6;  // [-] of the length
        load.from = std::clamp(x1 - 0.5 * point, 0.0, 1.0 - point), load.to = load.from + point;
        load.q1 = load.q2 = p1 / (point * length) * direction;
      }
      return load;
    });
  }

  void read_facet(const Card& card, double factor) {
    std::vector<int> nodes;
    for (std::size_t i = 2; i < 6 && !card.blank(i); ++i) nodes.push_back(stage_.node(card, card.integer(i)));
    if (nodes.size() < 3) card.fail("has fewer than three grids", "give three or four");
    stage_.press(nodes, -factor * card.number(1));
  }

  /// PLOAD2: P, EID, EID, …, or EID THRU EID; PLOAD4: EID, P1 to P4, and THRU EID or the corners of a solid's face.
  void read_pressure(const Card& card, double factor) {
    const bool four = card.name == "PLOAD4";
    const std::size_t first = four ? 1 : 2, thru = four ? 6 : 3;
    const double stated = card.number(four ? 2 : 1), p = factor * stated;
    for (std::size_t i = 3; four && i < 6; ++i)
      if (card.number_or(i, stated) != stated)
        card.fail("has a pressure that varies over its face, which is not read", "give P1 alone");
    for (std::size_t i = 8; four && i < card.size(); ++i)
      if (!card.blank(i) && card.text(i) != "0")
        card.fail("gives its pressure a direction, which is not read", "write it as FORCE of grids");
    std::vector<long> ids;
    if (card.word(thru) == "THRU") {
      for (long id = card.integer(first); id <= card.integer(thru + 1); ++id)
        if (!stage_.pieces(id).empty()) ids.push_back(id);
    } else {
      for (std::size_t i = first; i < (four ? 2 : card.size()); ++i)
        if (!card.blank(i)) ids.push_back(card.integer(i));
    }
    for (const long id : ids) press(card, id, p);
  }

  void press(const Card& card, long id, double p) {
    const fe::Element& e = stage_.element(card, id);
    if (e.type != fe::ElementType::solid || card.name != "PLOAD4" || card.blank(6)) return stage_.press_shell(card, id, p);
    // G1 lies on the face; G3 is the corner opposite to it on a hexahedron's, G4 the corner off a tetrahedron's.
    const int g1 = stage_.node(card, card.integer(6)), other = card.blank(7) ? -1 : stage_.node(card, card.integer(7));
    const bool hexahedron = e.nodes.size() == 8 || e.nodes.size() == 20;
    const auto& faces = solid_faces(hexahedron ? 8 : 4);  // their corners
    for (std::size_t face = 0; face < faces.size(); ++face) {
      const auto nodes = each_of(faces[face], [&](std::size_t i) { return e.nodes[i]; });
      const auto at = std::ranges::find(nodes, g1);
      if (at == nodes.end() || contains(nodes, other) != hexahedron) continue;
      if (hexahedron && nodes[static_cast<std::size_t>((at - nodes.begin()) + 2) % 4] != other) continue;
      return stage_.press_solid(card, id, face, p);
    }
    card.fail(fmt::format("names no face of element {}", id),
              "give G1 and G3 at opposite corners of the face, of a tetrahedron G1 on it and G4 off it");
  }

  void read_gravity(const Card& card, double factor) {
    stage_.accelerate(factor * in_basic(card, card.integer_or(1, 0), Eigen::Vector3d::Zero(), card.number(2) * card.vector(3)));
  }

  /// Movements of supports: G1, C1, D1, G2, C2, D2 of the cards with this name and set.
  void move_supports(const std::string& name, const std::optional<long>& set, double factor = 1.0) {
    for (const Card& card : parts_.deck.cards()) {
      if (card.name != name || (set && card.integer(0) != *set)) continue;
      for (std::size_t i = 1; i < card.size(); i += 3) {
        const double size = card.blank(i) ? 0.0 : card.number_or(i + 2, 0.0);
        if (card.blank(i) || (size == 0.0 && name == "SPC")) continue;
        move_support(card, card.integer(i), components(card, i + 1), factor * size);
      }
    }
  }

  void move_support(const Card& card, long grid, const Directions& flags, double size) {
    const Eigen::Matrix3d axes = parts_.displacement_axes(card, grid);
    for (int c = 0; c < 6; ++c)
      if (flags[fe::slot(c)]) stage_.move(card, stage_.node(card, grid), c, size, axes);
  }

  /// Temperatures of a set: of grids, and of all others (TEMPD).
  struct Temperatures {
    std::map<long, double> of;
    std::optional<double> otherwise;
  };

  Temperatures temperatures(long set) const {
    Temperatures found;
    for (const Card& card : parts_.deck.cards()) {
      if (card.name == "TEMP" && card.integer(0) == set)
        for (std::size_t i = 1; i + 1 < card.size(); i += 2)
          if (!card.blank(i)) found.of[card.integer(i)] = card.number(i + 1);
      for (std::size_t i = 0; card.name == "TEMPD" && i + 1 < card.size(); i += 2)
        if (card.integer(i) == set) found.otherwise = card.number(i + 1);
    }
    return found;
  }

  void warm_all() {
    const auto load = subcase_.chosen.find("TEMPERATURE(LOAD)"), initial = subcase_.chosen.find("TEMPERATURE(INITIAL)");
    if (load == subcase_.chosen.end()) return;
    const bool has_initial = initial != subcase_.chosen.end();
    const Temperatures now = temperatures(load->second), before = has_initial ? temperatures(initial->second) : Temperatures{};
    std::map<long, double> by_element;
    for (const Card& card : parts_.deck.cards())
      if (card.name == "TEMPRB" && card.integer(0) == load->second)
        by_element[card.integer(1)] = 0.5 * (card.number(2) + card.number_or(3, 0.0));
    stage_.warm([&](const fe::Element& e, long grid, const Expansion& of) {
      const auto mean = by_element.find(e.id);
      const double t1 = mean != by_element.end() ? mean->second : at(now, grid, load->second);
      return t1 - (has_initial ? at(before, grid, initial->second) : of.reference_K);
    });
  }

  double at(const Temperatures& temperatures, long grid, long set) const {
    if (const auto found = temperatures.of.find(grid); found != temperatures.of.end()) return found->second;
    if (temperatures.otherwise) return *temperatures.otherwise;
    parts_.deck.whole("TEMP").fail(fmt::format("the set of temperatures {} has none for grid {}", set, grid),
                                   "give TEMPD for the others");
  }

  Parts& parts_;
  const Subcase& subcase_;
  DeckStage stage_;
};

}  // namespace

void read_stage(Parts& parts) {
  const CaseControl& control = parts.deck.case_control();
  const DeckPlace statsub = parts.deck.whole("STATSUB");
  std::optional<long> wanted;
  for (const Subcase& subcase : control.subcases) {
    const auto chosen = subcase.chosen.find("STATSUB");
    if (chosen == subcase.chosen.end()) continue;
    if (wanted && *wanted != chosen->second)
      statsub.fail(fmt::format("names subcase {} in one subcase and {} in another", *wanted, chosen->second),
                   "leave one modal subcase in the deck");
    wanted = chosen->second;
  }
  if (!wanted) return;
  const auto found = std::ranges::find(control.subcases, *wanted, &Subcase::id);
  if (found == control.subcases.end())
    statsub.fail(fmt::format("names subcase {}, which the case control does not have", *wanted),
                 "name the static subcase whose loads act");
  if (found->chosen.contains("DEFORM"))
    parts.deck.whole("DEFORM").fail(
        fmt::format("of subcase {} strains the structure of the modes that STATSUB asks for, and is not read", *wanted),
        "write it as temperatures or forces");
  StageReader(parts, *found).read();
}

}  // namespace twindeck::model_io::nastran
