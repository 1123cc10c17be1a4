#include "model_io/ansys.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

#include "core/lists.hpp"
#include "io/text_lines.hpp"
#include "model_io/ansys_ignored.hpp"
#include "model_io/ansys_mesh.hpp"
#include "model_io/ansys_parts.hpp"
#include "model_io/ansys_properties.hpp"
#include "model_io/ansys_selection.hpp"
#include "model_io/ansys_stage.hpp"
#include "model_io/ansys_supports.hpp"

namespace twindeck::model_io {
namespace ansys {
namespace {

void read_title(Parts& parts, const Command& command) { parts.model.title = command.rest; }

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

void refuse_table(Parts& /*parts*/, const Command& command) {
  command.fail(fmt::format("material tables ({}) are not supported", command.word(0)),
               "give EX, PRXY and DENS of an isotropic material by MP");
}

/// Before the first solution; archives begin with one.
void read_clear(Parts& parts, const Command& command) {
  if (!parts.nodes.empty() || !parts.elements.empty())
    command.fail("throws away the model that stands before it", "leave out what it throws away, or the command");
}

void refuse_file(Parts& /*parts*/, const Command& command) {
  command.fail("other files are not read", "put the text of the file in its place");
}

using Handler = void (*)(Parts&, const Command&);
using Handlers = std::map<std::string, Handler>;

/// Commands that change the structure.
const Handlers& structural() {
  static const Handlers known = by_word<Handler>({{read_node_block, {"NBLO"}},
                                                  {read_element_block, {"EBLO"}},
                                                  {read_type_block, {"ETBL"}},
                                                  {read_real_block, {"RLBL"}},
                                                  {read_section_block, {"SECB"}},
                                                  {read_node, {"N"}},
                                                  {read_element, {"E"}},
                                                  {read_numbered_element, {"EN"}},
                                                  {read_more_nodes, {"EMOR"}},
                                                  {fill_nodes, {"FILL"}},
                                                  {generate_nodes, {"NGEN"}},
                                                  {generate_elements, {"EGEN"}},
                                                  {read_type, {"ET"}},
                                                  {read_option, {"KEYO"}},
                                                  {read_reals, {"R"}},
                                                  {read_more_reals, {"RMOR"}},
                                                  {read_changed_reals, {"RMOD"}},
                                                  {read_property, {"MP"}},
                                                  {read_property_data, {"MPDA"}},
                                                  {read_section_type, {"SECT"}},
                                                  {read_section_data, {"SECD"}},
                                                  {read_section_offset, {"SECO"}},
                                                  {read_section_control, {"SECC"}},
                                                  {read_support, {"D"}},
                                                  {read_released_support, {"DDEL"}},
                                                  {read_symmetry, {"DSYM"}},
                                                  {read_couple, {"CP"}},
                                                  {read_rigid_region, {"CERI"}},
                                                  {read_lumped, {"LUMP"}},
                                                  {refuse_table, {"TB"}},
                                                  {read_equation, {"CE"}},
                                                  {read_clear, {"/CLEA"}},
                                                  {refuse_file, {"/INPU", "*USE", "CDRE", "RESU"}}});
  return known;
}

/// Commands that say what is selected, active or called by a name.
const Handlers& others() {
  static const Handlers known = by_word<Handler>({{read_component_block, {"CMBL"}},
                                                  {read_attribute, {"TYPE", "MAT", "REAL", "SECN"}},
                                                  {read_axes, {"CSYS", "LOCA", "CLOC", "CS"}},
                                                  {read_component, {"CM"}},
                                                  {select_component, {"CMSE"}},
                                                  {select_nodes, {"NSEL"}},
                                                  {select_elements, {"ESEL"}},
                                                  {select_nodes_of_elements, {"NSLE"}},
                                                  {select_all, {"ALLS"}},
                                                  {read_title, {"/TITL"}},
                                                  {read_units, {"/UNIT"}}});
  return known;
}

/// A parameter that is set: kept if it is plain arithmetic, else unknown from here on.
void set_parameter(Parts& parts, const std::string& name, const std::string& value) {
  parts.parameters.erase(upper_case(name));
  if (const auto number = evaluate(value, parts.parameters)) parts.parameters[upper_case(name)] = *number;
}

/// Commands of the parameter language. @return true if it was one that needs no more
bool read_parameter(Parts& parts, const Command& command) {
  const bool sets = command.key == "=" || command.key == "*SET", gets = command.key == "*GET";
  if (sets) set_parameter(parts, command.text(0), command.text(1));
  if (gets) parts.parameters.erase(upper_case(command.text(0)));
  // Arrays: no field can use them, since evaluate() knows none.
  return sets || gets || command.key == "*DIM" || command.key == "*DEL" || command.key == "*VFIL";
}

bool says_nothing(const Command& command) { return ignored(command.key) != nullptr || command.key == "/EOF"; }

/// *IF … *ENDIF and *DO … *ENDDO are read over if nothing inside matters, and refused otherwise: nothing is decided here.
void read_over_block(Parts& parts, const Command& start) {
  const auto opens = [](const Command& c) {
    if (c.key == "*DO" || c.key == "*DOWH") return true;
    for (std::size_t i = 0; i < c.fields.size(); ++i)
      if (c.key == "*IF" && c.word(i) == "THEN") return true;
    return false;
  };
  const auto refuse = [&](const Command& c) {
    c.fail(fmt::format("depends on the {} of line {}, and conditions and loops are not evaluated", start.name, start.line),
           "write the commands out, or let ANSYS write an archive (CDWRITE,DB)");
  };
  if (!opens(start)) refuse(start);
  Command command;
  for (int depth = 1; depth > 0;) {
    if (!parts.deck.next(command)) start.fail("has no end", "write *ENDIF or *ENDDO");
    if (opens(command)) {
      ++depth;
    } else if (command.key == "*ENDI" || command.key == "*ENDD") {
      --depth;
    } else if (command.key == "=" || command.key == "*SET" || command.key == "*GET") {
      if (!command.blank(0)) parts.parameters.erase(upper_case(command.fields[0]));
    } else if (is_load(command.key)) {
      parts.loads.leave(command);
    } else if (command.key != "*ELSE" && !read_parameter(parts, command) && !says_nothing(command)) {
      refuse(command);
    }
  }
}

/// Of what follows the first solution, the loads and kinds of solutions up to the modal one are read. A second solution of a
/// structure that was changed between them is another model, unless it answers another question than the modes that are found
/// already: a spectrum, a response.
void check_rest(Parts& parts, bool modal_is_done) {
  Command command, change;
  bool changed = false;
  while (parts.deck.next(command)) {
    if (modal_is_done && command.key == "/CLEA")
      return parts.notes.push_back(
          fmt::format("what follows {} (line {}) is another model and is not read", command.name, command.line));
    if (modal_is_done && (command.key == "PSTR" || command.key == "PERT") && command.word(0) != "OFF")
      command.fail("asks for modes of the loaded structure in a further solution, of which only the first is read",
                   "keep the solution that is meant");
    if ((!modal_is_done || command.key == "ANTY") && read_solution(parts, command)) continue;
    if (!modal_is_done && read_load(parts, command)) continue;
    if (command.key == "SOLV" && !changed && !modal_is_done) modal_is_done = read_solve(parts, command);
    if (command.key == "SOLV" && changed && (!modal_is_done || parts.modal))
      change.fail("changes the structure between two solutions, of which only the first is read",
                  modal_is_done ? "keep the solution that is meant"
                                : "keep the solution that is meant; where the modes follow a static solution, give the same "
                                  "structure and supports to both");
    if (changed || !structural().contains(command.key)) continue;
    change = command;
    changed = true;
  }
}

void read_commands(Parts& parts) {
  Command command;
  while (parts.deck.next(command)) {
    if (command.key == "/EOF" || command.key == "/EXIT") return;
    if (command.key == "SOLV") return check_rest(parts, read_solve(parts, command));
    if (read_solution(parts, command) || read_load(parts, command)) continue;
    if (const auto found = structural().find(command.key); found != structural().end()) {
      found->second(parts, command);
    } else if (const auto other = others().find(command.key); other != others().end()) {
      other->second(parts, command);
    } else if (const Ignored* why = ignored(command.key); why != nullptr) {
      if (why->told) parts.tell(command);
    } else if (command.key == "*IF" || command.key == "*DO" || command.key == "*DOWH") {
      read_over_block(parts, command);
    } else if (!read_parameter(parts, command)) {
      command.fail("unsupported command",
                   "leave it out if the model is meant without it, or let ANSYS write an archive (CDWRITE,DB); "
                   "docs/import_ansys.md lists what is read");
    }
  }
}

}  // namespace
}  // namespace ansys

bool is_ansys_deck(const std::filesystem::path& file) {
  constexpr int most_lines = 5000;  // of comments and settings before the mesh
  constexpr std::array<const char*, 4> meshes = {"NBLO", "EBLO", "ETBL", "/PREP"};
  io::TextLines stream(file, io::longest_text);
  std::string text;
  for (int i = 0; i < most_lines && stream.next(text); ++i)
    for (const ansys::Command& command : ansys::split_commands(text, &file, i + 1))
      if (contains(meshes, command.key) || (command.key == "ET" && text.find(',') != std::string::npos)) return true;
  return false;
}

ImportedModel read_ansys(const std::filesystem::path& path) {
  ansys::Parts parts(path);
  parts.model.source = path.string();
  ansys::read_commands(parts);
  ansys::build_model(parts);
  for (const auto& [name, line] : parts.told)
    parts.notes.push_back(fmt::format("{} (line {}) does not enter stiffness or mass and is left out", name, line));
  return parts.finished({path}, "EBLOCK, E or EN commands before SOLVE");
}

}  // namespace twindeck::model_io
