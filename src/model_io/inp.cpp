#include "model_io/inp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "model_io/folder_parts.hpp"
#include "model_io/inp_assign.hpp"
#include "model_io/inp_attachments.hpp"
#include "model_io/inp_elements.hpp"
#include "model_io/inp_links.hpp"
#include "model_io/inp_materials.hpp"
#include "model_io/inp_mesh.hpp"
#include "model_io/inp_parts.hpp"
#include "model_io/model_toml.hpp"

namespace twindeck::model_io {
namespace {

using Reader = void (*)(InpParts&, const InpCard&);

/// Cards in the order in which they must be understood: what defines, then what refers to it.
const std::vector<std::map<std::string, Reader>>& passes() {
  static const std::vector<std::map<std::string, Reader>> readers = {
      {{"NODE", read_inp_nodes},
       {"ELEMENT", read_inp_elements},
       {"MATERIAL", read_inp_material},
       {"ELASTIC", read_inp_elastic},
       {"DENSITY", read_inp_density},
       {"ORIENTATION", read_inp_orientation}},
      {{"NSET", read_inp_set}, {"ELSET", read_inp_set}, {"EQUATION", read_inp_equation}},
      {{"BEAM SECTION", assign_inp_section},
       {"BEAM GENERAL SECTION", assign_inp_section},
       {"SHELL SECTION", assign_inp_section},
       {"USER SECTION", assign_inp_section},
       {"SOLID SECTION", assign_inp_section},
       {"SPRING", attach_inp_spring},
       {"DASHPOT", attach_inp_spring},
       {"MASS", attach_inp_mass},
       {"ROTARY INERTIA", attach_inp_mass},
       {"BOUNDARY", attach_inp_boundary},
       {"RIGID BODY", attach_inp_rigid_body},
       {"MPC", attach_inp_mpc}}};
  return readers;
}

/// Say nothing about the structure: headings, output requests, the bounds of parts and steps.
const std::vector<std::string>& silent_cards() {
  static const std::vector<std::string> cards = {"HEADING",        "PREPRINT",      "RESTART",   "OUTPUT",   "NODE OUTPUT",
                                                 "ELEMENT OUTPUT", "NODE PRINT",    "NODE FILE", "EL PRINT", "EL FILE",
                                                 "CONTACT OUTPUT", "ENERGY OUTPUT", "PART",      "END PART", "ASSEMBLY",
                                                 "END ASSEMBLY",   "END INSTANCE",  "STEP",      "END STEP", "STATIC",
                                                 "FREQUENCY",      "FILE FORMAT"};
  return cards;
}

/// Loads and data of other physics: no part of the stiffness and mass of a model, but worth a word.
const std::vector<std::string>& noted_cards() {
  static const std::vector<std::string> cards = {"CLOAD",   "DLOAD",     "DSLOAD",       "TEMPERATURE",   "AMPLITUDE",
                                                 "DAMPING", "EXPANSION", "CONDUCTIVITY", "SPECIFIC HEAT", "PHYSICAL CONSTANTS"};
  return cards;
}

bool is_in(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

void refuse_unknown(const InpFile& file) {
  std::vector<std::string> known = silent_cards();
  for (const auto& pass : passes()) {
    for (const auto& [keyword, reader] : pass) known.push_back(keyword);
  }
  int instances = 0;
  std::string above;
  for (const InpCard& card : file.cards()) {
    if (card.keyword == "TRANSVERSE SHEAR STIFFNESS" && above == "BEAM GENERAL SECTION") {
      // read together with its section
    } else if (card.keyword == "INSTANCE") {
      if (++instances > 1 || !card.data.empty()) {
        file.fail(card, card.line, "a second instance, or one that is moved, is not supported",
                  "write the model as one part (flat input)");
      }
    } else if (card.keyword == "USER ELEMENT" && upper_case(card.get("TYPE")) == "US3") {
      // announces the three-node shell US3, which *ELEMENT lists
    } else if (card.keyword == "INCLUDE") {
      file.fail(card, card.line, "unsupported card: other files are not read", "put the text of the file in its place");
    } else if (!is_in(known, card.keyword) && !is_in(noted_cards(), card.keyword)) {
      file.fail(card, card.line, "unsupported card" + did_you_mean(card.keyword, known),
                "leave it out if the model is meant without it; docs/my_model.md lists what is read");
    }
    above = card.keyword;
  }
}

void note_loads(InpParts& parts) {
  std::map<std::string, long> first;
  for (const InpCard& card : parts.file.cards()) {
    if (is_in(noted_cards(), card.keyword)) first.emplace(card.keyword, card.line);
  }
  for (const auto& [keyword, line] : first) {
    parts.notes.push_back(fmt::format("*{} (line {}) does not enter stiffness or mass and is left out", keyword, line));
  }
}

void name_points(InpParts& parts) {
  for (const auto& [key, set] : parts.node_sets) {
    if (set.members.size() != 1) continue;
    if (const auto node = parts.node_position.find(set.members.front()); node != parts.node_position.end()) {
      parts.model.monitoring_points.emplace(set.name, node->second);
    }
  }
}

}  // namespace

InpModel read_inp(const std::filesystem::path& path) {
  const InpFile file = InpFile::read(path);
  refuse_unknown(file);
  InpParts parts(file);
  parts.model.source = path.string();
  for (const auto& pass : passes()) {
    for (const InpCard& card : file.cards()) {
      if (card.keyword == "HEADING" && !card.data.empty()) parts.model.title = card.data.front().fields.front();
      if (const auto reader = pass.find(card.keyword); reader != pass.end()) reader->second(parts, card);
    }
    if (!parts.elements.empty()) parts.last_element_id = std::max(parts.last_element_id, parts.elements.rbegin()->first);
  }
  attach_inp_equations(parts);
  for (const auto& [id, element] : parts.elements) {
    if (element.used == 0)
      file.fail(*element.card, element.line, fmt::format("element {} has no section, spring or mass card", id),
                "give its set one");
  }
  if (parts.model.elements.empty())
    throw InputError({path.string(), 0, ""}, "holds no element", "expected *ELEMENT cards with their sections");
  note_loads(parts);
  name_points(parts);
  auto beside = path;
  beside.replace_extension(".toml");
  if (std::filesystem::exists(beside)) read_model_toml(beside, parts.model);
  return {std::move(parts.model), std::move(parts.notes)};
}

}  // namespace twindeck::model_io
