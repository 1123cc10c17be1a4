#include "model_io/inp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "model_io/inp_attachments.hpp"
#include "model_io/inp_mesh.hpp"
#include "model_io/inp_parts.hpp"
#include "model_io/inp_sections.hpp"
#include "model_io/inp_stage.hpp"
#include "model_io/inp_surfaces.hpp"
#include "model_io/inp_ties.hpp"

namespace twindeck::model_io {
namespace {

using Reader = void (*)(InpParts&, const InpCard&);

/// Cards in the order in which they must be understood: what defines, then what refers to it.
const std::vector<std::map<std::string, Reader>>& passes() {
  static const std::vector<std::map<std::string, Reader>> readers = {
      by_word<Reader>({{read_inp_nodes, {"NODE"}}}),
      by_word<Reader>({{read_inp_elements, {"ELEMENT"}},
                       {read_inp_material, {"MATERIAL"}},
                       {read_inp_elastic, {"ELASTIC"}},
                       {read_inp_density, {"DENSITY"}},
                       {read_inp_expansion, {"EXPANSION"}},
                       {read_inp_orientation, {"ORIENTATION"}}}),
      by_word<Reader>({{read_inp_set, {"NSET", "ELSET"}}}),
      by_word<Reader>({{read_inp_surface, {"SURFACE"}}, {read_inp_transform, {"TRANSFORM"}}}),
      by_word<Reader>({{read_inp_equation, {"EQUATION"}},
                       {assign_inp_section,
                        {"BEAM SECTION", "BEAM GENERAL SECTION", "SHELL SECTION", "SHELL GENERAL SECTION", "USER SECTION",
                         "SOLID SECTION"}},
                       {attach_inp_spring, {"SPRING", "DASHPOT"}},
                       {attach_inp_mass, {"MASS", "ROTARY INERTIA"}},
                       {attach_inp_rigid_body, {"RIGID BODY"}},
                       {attach_inp_mpc, {"MPC"}},
                       {attach_inp_joint, {"JOINT"}},
                       {attach_inp_coupling, {"COUPLING"}},
                       {attach_inp_kinematic_coupling, {"KINEMATIC COUPLING"}}})};
  return readers;
}

/// Say nothing about the structure: headings, output requests, the bounds of parts and steps.
const std::vector<std::string>& silent_cards() {
  static const std::vector<std::string> cards = {
      "HEADING",   "PREPRINT",     "RESTART",     "OUTPUT",         "NODE OUTPUT",   "ELEMENT OUTPUT", "NODE PRINT",
      "NODE FILE", "EL PRINT",     "EL FILE",     "CONTACT OUTPUT", "ENERGY OUTPUT", "PART",           "END PART",
      "ASSEMBLY",  "END ASSEMBLY", "INSTANCE",    "END INSTANCE",   "STEP",          "END STEP",       "STATIC",
      "AMPLITUDE", "FREQUENCY",    "FILE FORMAT", "NORMAL MODE"};
  return cards;
}

/// Data of other physics: no part of the stiffness and mass of a model, but worth a word.
bool is_noted(const std::string& card) {
  return contains(std::array{"DAMPING", "CONDUCTIVITY", "SPECIFIC HEAT", "PHYSICAL CONSTANTS"}, card);
}

void refuse_unknown(const InpPlan& plan) {
  std::vector<std::string> known = silent_cards();
  known.insert(known.end(), {"BOUNDARY", "TIE", "RELEASE", "NONSTRUCTURAL MASS", "CLOAD", "DLOAD", "DSLOAD", "TEMPERATURE",
                             "INITIAL CONDITIONS"});
  for (const auto& pass : passes())
    for (const auto& [keyword, reader] : pass) known.push_back(keyword);
  std::string above;
  for (const InpReading& reading : plan.readings) {
    const InpCard& card = *reading.card;
    const bool with_above = (card.keyword == "TRANSVERSE SHEAR STIFFNESS" && above == "BEAM GENERAL SECTION") ||
                            ((card.keyword == "KINEMATIC" || card.keyword == "DISTRIBUTING") && above == "COUPLING");
    // US3 is a three-node shell, which *ELEMENT lists.
    const bool announces_shell = card.keyword == "USER ELEMENT" && upper_case(card.get("TYPE")) == "US3";
    if (!with_above && !announces_shell && !contains(known, card.keyword) && !is_noted(card.keyword))
      card.fail("unsupported card" + did_you_mean(card.keyword, known),
                "leave it out if the model is meant without it; docs/my_model.md lists what is read");
    above = card.keyword;
  }
}

void note_loads(InpParts& parts, const InpPlan& plan, const InpStage& stage) {
  std::map<std::string, long> first;
  for (const InpCard* card : stage.unused)
    if (first.emplace(card->keyword, card->line).second)
      parts.notes.push_back(
          fmt::format("*{} (line {}) is left out: no step asks for modes of the structure under it, as a static step with "
                      "NLGEOM does, and in CalculiX one before *STEP, PERTURBATION",
                      card->keyword, card->line));
  first.clear();
  for (const InpReading& reading : plan.readings)
    if (is_noted(reading.card->keyword)) first.emplace(reading.card->keyword, reading.card->line);
  for (const auto& [keyword, line] : first)
    parts.notes.push_back(fmt::format("*{} (line {}) does not enter stiffness or mass and is left out", keyword, line));
}

/// Supports of the step whose modes are asked for.
void attach_supports(InpParts& parts, const InpPlan& plan) {
  const std::vector<const InpCard*> in_force = boundaries_in_force(parts.file);
  for (const InpReading& reading : plan.readings) {
    if (!contains(in_force, reading.card)) continue;
    parts.scope = reading.scope;
    attach_inp_boundary(parts, *reading.card);
  }
  for (const auto& [id, support] : parts.held_own)
    parts.hold_along(support.at, support.name, parts.node_position.at(id), parts.node_axes.at(id), support.fixed);
}

/// Ties, when sections, links and equations are known; masses and released ends of elements.
void attach_to_elements(InpParts& parts, const InpPlan& plan) {
  for (const InpReading& reading : plan.readings) {
    parts.scope = reading.scope;
    if (reading.card->keyword == "TIE") attach_inp_tie(parts, *reading.card);
    if (reading.card->keyword == "RELEASE") release_inp_ends(parts, *reading.card);
    if (reading.card->keyword == "NONSTRUCTURAL MASS") spread_inp_mass(parts, *reading.card);
  }
}

void name_points(InpParts& parts) {
  for (const auto& [key, set] : parts.node_sets) {
    if (set.members.size() != 1) continue;
    if (const auto node = parts.node_position.find(set.members.front()); node != parts.node_position.end())
      parts.model.monitoring_points.emplace(parts.set_name(parts.node_sets, set), node->second);
  }
}

}  // namespace

ImportedModel read_inp(const std::filesystem::path& path) {
  const InpFile file = InpFile::read(path);
  InpPlan plan = plan_readings(file);
  refuse_unknown(plan);
  InpParts parts(file);
  parts.scopes = plan.scopes;
  parts.notes = plan.notes;
  parts.model.source = path.string();
  const InpStage stage = find_inp_stage(file, plan);
  if (!stage.note.empty()) parts.notes.push_back(stage.note);
  if (stage.asked) refuse_other_supports_than_of_static_steps(file);
  for (const InpReading& reading : stage.cards) parts.of_stage.insert(reading.card);
  for (const auto& pass : passes()) {
    for (const InpReading& reading : plan.readings) {
      const InpCard& card = *reading.card;
      if (card.keyword == "HEADING" && !card.data.empty()) parts.model.title = card.data.front().fields.front();
      parts.scope = reading.scope;
      if (const auto reader = pass.find(card.keyword); reader != pass.end()) reader->second(parts, card);
    }
    if (!parts.elements.empty()) parts.last_element = std::max(parts.last_element, parts.elements.rbegin()->first);
  }
  attach_supports(parts, plan);
  attach_inp_equations(parts);
  attach_to_elements(parts, plan);
  settle_inp_constraints(parts);
  for (const auto& [id, element] : parts.elements)
    if (element.used == 0)
      element.at->fail(fmt::format("element {} has no section, spring or mass card", id), "give its set one");
  note_loads(parts, plan, stage);
  parts.drop_unused_nodes();
  for (const auto& [id, body] : parts.turned_by)
    if (parts.node_position.contains(id))
      body.second->fail(fmt::format("ROT NODE {} carries an element, spring or mass too, which is not read", id),
                        "give it to the REF NODE, whose rotations are degrees of freedom 4 to 6");
  read_inp_stage(parts, stage);
  name_points(parts);
  return parts.finished({file.files().begin(), file.files().end()}, "*ELEMENT cards with their sections");
}

}  // namespace twindeck::model_io
