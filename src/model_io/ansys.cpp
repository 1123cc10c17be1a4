#include "model_io/ansys.hpp"

#include <fmt/format.h>

#include <fstream>
#include <map>

#include "core/error.hpp"
#include "model_io/ansys_blocks.hpp"
#include "model_io/ansys_generate.hpp"
#include "model_io/ansys_ignored.hpp"
#include "model_io/ansys_mesh.hpp"
#include "model_io/ansys_parts.hpp"
#include "model_io/ansys_properties.hpp"
#include "model_io/ansys_selection.hpp"
#include "model_io/ansys_stage.hpp"
#include "model_io/ansys_supports.hpp"
#include "model_io/ansys_ties.hpp"
#include "model_io/folder_parts.hpp"
#include "model_io/inp_cards.hpp"
#include "model_io/model_toml.hpp"

namespace twindeck::model_io {
namespace ansys {
namespace {

/// What reads a command.
struct Reader {
  void (*handler)(Parts&, const Command&);
  bool structure;  ///< changes the structure, rather than what is selected or active
};

void read_title(Parts& parts, const Command& command) { parts.model.title = command.text; }

void read_lumped(Parts& parts, const Command& command) {
  parts.model.formulation.lumped_mass = command.word(0) == "ON" || command.word(0) == "1";
}

void read_units(Parts& parts, const Command& command) {
  const std::string system = command.word(0);
  if (system == "SI" || system == "MKS" || system.empty()) return;
  parts.notes.push_back(
      fmt::format("/UNITS,{}: the numbers are taken as they stand, as metres, kilograms and newtons; frequencies hold in any "
                  "consistent system",
                  system));
}

void refuse_table(Parts& parts, const Command& command) {
  parts.fail(command, fmt::format("material tables ({}) are not supported", command.word(0)),
             "give EX, PRXY and DENS of an isotropic material by MP");
}

void refuse_file(Parts& parts, const Command& command) {
  parts.fail(command, "other files are not read", "put the text of the file in its place");
}

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> known = {{"NBLO", {read_node_block, true}},
                                                      {"EBLO", {read_element_block, true}},
                                                      {"ETBL", {read_type_block, true}},
                                                      {"CMBL", {read_component_block, false}},
                                                      {"RLBL", {read_real_block, true}},
                                                      {"SECB", {read_section_block, true}},
                                                      {"N", {read_node, true}},
                                                      {"E", {read_element, true}},
                                                      {"EN", {read_numbered_element, true}},
                                                      {"EMOR", {read_more_nodes, true}},
                                                      {"FILL", {fill_nodes, true}},
                                                      {"NGEN", {generate_nodes, true}},
                                                      {"EGEN", {generate_elements, true}},
                                                      {"TYPE", {read_attribute, false}},
                                                      {"MAT", {read_attribute, false}},
                                                      {"REAL", {read_attribute, false}},
                                                      {"SECN", {read_attribute, false}},
                                                      {"CSYS", {read_axes, false}},
                                                      {"LOCA", {read_axes, false}},
                                                      {"CLOC", {read_axes, false}},
                                                      {"CS", {read_axes, false}},
                                                      {"ET", {read_type, true}},
                                                      {"KEYO", {read_option, true}},
                                                      {"R", {read_reals, true}},
                                                      {"RMOR", {read_more_reals, true}},
                                                      {"RMOD", {read_changed_reals, true}},
                                                      {"MP", {read_property, true}},
                                                      {"MPDA", {read_property_data, true}},
                                                      {"SECT", {read_section_type, true}},
                                                      {"SECD", {read_section_data, true}},
                                                      {"SECO", {read_section_offset, true}},
                                                      {"SECC", {read_section_control, true}},
                                                      {"CM", {read_component, false}},
                                                      {"CMSE", {select_component, false}},
                                                      {"NSEL", {select_nodes, false}},
                                                      {"ESEL", {select_elements, false}},
                                                      {"NSLE", {select_nodes_of_elements, false}},
                                                      {"ALLS", {select_all, false}},
                                                      {"D", {read_support, true}},
                                                      {"DDEL", {read_released_support, true}},
                                                      {"CP", {read_couple, true}},
                                                      {"CERI", {read_rigid_region, true}},
                                                      {"/TITL", {read_title, false}},
                                                      {"LUMP", {read_lumped, true}},
                                                      {"/UNIT", {read_units, false}},
                                                      {"TB", {refuse_table, true}},
                                                      {"CE", {read_equation, true}},
                                                      {"/INPU", {refuse_file, true}},
                                                      {"*USE", {refuse_file, true}},
                                                      {"CDRE", {refuse_file, true}},
                                                      {"RESU", {refuse_file, true}}};
  return known;
}

/// A parameter that is set: kept if it is plain arithmetic, else unknown from here on.
void set_parameter(Parts& parts, const std::string& name, const std::string& value) {
  parts.parameters.erase(upper_case(name));
  if (const auto number = evaluate(value, parts.parameters)) parts.parameters[upper_case(name)] = *number;
}

/// Commands of the parameter language. @return true if it was one that needs no more
bool read_parameter(Parts& parts, const Command& command) {
  const auto field = [&](std::size_t i) { return command.blank(i) ? std::string() : command.fields[i]; };
  if (command.key == "=" || command.key == "*SET") {
    set_parameter(parts, field(0), field(1));
  } else if (command.key == "*GET") {
    parts.parameters.erase(upper_case(field(0)));
  } else {
    // Arrays: no field can use them, since evaluate() knows none.
    return command.key == "*DIM" || command.key == "*DEL" || command.key == "*VFIL";
  }
  return true;
}

bool says_nothing(const Command& command) { return ignored(command.key) != nullptr || command.key == "/EOF"; }

/// *IF … *ENDIF and *DO … *ENDDO are read over if nothing inside matters, and refused otherwise: nothing is decided here.
void read_over_block(Parts& parts, const Command& start) {
  const auto opens = [](const Command& c) {
    if (c.key == "*DO" || c.key == "*DOWH") return true;
    for (std::size_t i = 0; i < c.fields.size(); ++i) {
      if (c.key == "*IF" && c.word(i) == "THEN") return true;
    }
    return false;
  };
  const auto refuse = [&](const Command& c) {
    parts.fail(c,
               fmt::format("depends on the {} of line {}, and conditions and loops are not evaluated", start.name, start.line),
               "write the commands out, or let ANSYS write an archive (CDWRITE,DB)");
  };
  if (!opens(start)) refuse(start);
  Command command;
  for (int depth = 1; depth > 0;) {
    if (!parts.deck.next(command)) parts.fail(start, "has no end", "write *ENDIF or *ENDDO");
    if (opens(command)) {
      ++depth;
    } else if (command.key == "*ENDI" || command.key == "*ENDD") {
      --depth;
    } else if (command.key == "=" || command.key == "*SET" || command.key == "*GET") {
      if (!command.blank(0)) parts.parameters.erase(upper_case(command.fields[0]));
    } else if (is_load(command.key)) {
      if (!parts.loads.not_read) parts.loads.not_read = command;
    } else if (command.key != "*ELSE" && !read_parameter(parts, command) && !says_nothing(command)) {
      refuse(command);
    }
  }
}

/// Of what follows the first solution, the loads and kinds of solutions up to the modal one are read. A second solution of a
/// structure that was changed between them is another model.
void check_rest(Parts& parts, bool modal_is_done) {
  Command command, change;
  bool changed = false;
  while (parts.deck.next(command)) {
    if (modal_is_done && (command.key == "PSTR" || command.key == "PERT") && command.word(0) != "OFF")
      parts.fail(command, "asks for modes of the loaded structure in a further solution, of which only the first is read",
                 "keep the solution that is meant");
    if (!modal_is_done && (read_solution(parts, command) || read_load(parts, command))) continue;
    if (command.key == "SOLV" && !changed && !modal_is_done) modal_is_done = read_solve(parts, command);
    if (command.key == "SOLV" && changed)
      parts.fail(change, "changes the structure between two solutions, of which only the first is read",
                 "keep the solution that is meant");
    const auto found = readers().find(command.key);
    if (changed || found == readers().end() || !found->second.structure) continue;
    change = command;
    changed = true;
  }
}

void tell(Parts& parts, const Command& command, const Ignored& why) {
  if (why.told) parts.told.emplace(upper_case(command.name), command.line);
}

void read_commands(Parts& parts) {
  Command command;
  while (parts.deck.next(command)) {
    if (command.key == "/EOF" || command.key == "/EXIT") return;
    if (command.key == "SOLV") return check_rest(parts, read_solve(parts, command));
    if (read_solution(parts, command) || read_load(parts, command)) continue;
    if (const auto found = readers().find(command.key); found != readers().end()) {
      found->second.handler(parts, command);
    } else if (const Ignored* why = ignored(command.key); why != nullptr) {
      tell(parts, command, *why);
    } else if (command.key == "*IF" || command.key == "*DO" || command.key == "*DOWH") {
      read_over_block(parts, command);
    } else if (!read_parameter(parts, command)) {
      parts.fail(command, "unsupported command",
                 "leave it out if the model is meant without it, or let ANSYS write an archive (CDWRITE,DB); "
                 "docs/import_ansys.md lists what is read");
    }
  }
}

}  // namespace
}  // namespace ansys

bool is_ansys_deck(const std::filesystem::path& file) {
  constexpr int most_lines = 5000;  // of comments and settings before the mesh
  std::ifstream stream(file);
  std::string text;
  for (int i = 0; i < most_lines && std::getline(stream, text); ++i) {
    for (const ansys::Command& command : ansys::split_commands(text, i + 1)) {
      const std::string& key = command.key;
      if (key == "NBLO" || key == "EBLO" || key == "ETBL" || key == "/PREP" ||
          (key == "ET" && text.find(',') != std::string::npos))
        return true;
    }
  }
  return false;
}

ImportedModel read_ansys(const std::filesystem::path& path) {
  ansys::Parts parts(path);
  parts.model.source = path.string();
  ansys::read_commands(parts);
  ansys::build_model(parts);
  if (parts.model.elements.empty() && parts.model.springs.empty())
    throw InputError({path.string(), 0, ""}, "holds no element", "expected EBLOCK, E or EN commands before SOLVE");
  for (const auto& [name, line] : parts.told)
    parts.notes.push_back(fmt::format("{} (line {}) does not enter stiffness or mass and is left out", name, line));
  auto beside = path;
  beside.replace_extension(".toml");
  if (std::filesystem::exists(beside)) read_model_toml(beside, parts.model);
  return {std::move(parts.model), std::move(parts.notes), {path}};
}

}  // namespace twindeck::model_io
