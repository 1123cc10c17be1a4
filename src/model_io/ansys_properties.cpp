#include "model_io/ansys_properties.hpp"

#include <fmt/format.h>

#include "core/lists.hpp"

/// Types with their key options, real constants, materials, sections.
namespace twindeck::model_io::ansys {
namespace {

constexpr long most_reals = 1000;  ///< constants of one set
constexpr std::size_t a_line = 6;  ///< constants that R and RMORE hold
constexpr std::size_t options_of_et = 6;

/// Sets constants `first` … of a set (from 1).
void set_reals(const Command& command, RealSet& set, std::size_t first) {
  for (std::size_t i = 1; i < command.fields.size(); ++i) {
    if (command.blank(i)) continue;
    const std::size_t at = first + i - 1;
    if (set.values.size() < at) set.values.resize(at, 0.0);
    set.values[at - 1] = command.number(i);
  }
}

/// Elasticity, density, and expansion for a static stage; other physics (conductivity, friction) does not enter a model.
bool is_mechanical(const std::string& label) {
  static const std::vector<std::string> labels = {"EX",   "EY",  "EZ",  "NUXY", "NUYZ", "NUXZ", "PRXY", "PRYZ",
                                                  "PRXZ", "GXY", "GYZ", "GXZ",  "DENS", "ALPX", "REFT"};
  return contains(labels, label);
}

void set_property(Parts& parts, const Command& command, const std::string& label, long material, double value) {
  if (is_mechanical(label))
    parts.materials[material][label] = {value, command.line};
  else if (label.starts_with("DM") || label == "DAMP" || label == "ALPD" || label == "BETD")
    parts.told.emplace("MP," + label, command.line);
}

SectionDefinition& current_section(Parts& parts, const Command& command) {
  const auto found = parts.sections.find(parts.section);
  if (found == parts.sections.end()) command.fail("stands before any SECTYPE", "give SECTYPE,number,type before it");
  return found->second;
}

}  // namespace

void read_type(Parts& parts, const Command& command) {
  const long id = command.integer(0);
  if (command.blank(1)) command.fail("names no element type", "write ET,number,name, for example ET,1,SHELL181");
  TypeDefinition definition{.name = command.fields[1], .type = element_type(command.word(1)), .line = command.line};
  for (std::size_t i = 0; i < options_of_et; ++i)
    if (!command.blank(i + 2)) definition.options[static_cast<int>(i) + 1] = {command.integer(i + 2), command.line};
  parts.types[id] = definition;
}

void read_option(Parts& parts, const Command& command) {
  const long id = command.integer(0), number = command.integer(1);
  const auto found = parts.types.find(id);
  if (found == parts.types.end()) command.fail(fmt::format("type {} is not defined", id), "give its ET command before");
  if (number < 1 || number > 200) command.fail(fmt::format("{} is no number of a key option", number), "give 1 to 18");
  found->second.options[static_cast<int>(number)] = {command.integer_or(2, 0), command.line};
}

void read_reals(Parts& parts, const Command& command) {
  parts.real = command.integer(0);
  parts.real_filled = a_line;
  RealSet set{{}, command.line};
  set_reals(command, set, 1);
  parts.reals[parts.real] = set;
}

void read_more_reals(Parts& parts, const Command& command) {
  const auto found = parts.reals.find(parts.real);
  if (found == parts.reals.end()) command.fail("stands before any R", "give R,number,constants before it");
  Command shifted = command;  // R has the number of the set in front of its constants
  shifted.fields.insert(shifted.fields.begin(), "");
  shifted.taken = -1;
  set_reals(shifted, found->second, parts.real_filled + 1);
  parts.real_filled += a_line;
}

void read_changed_reals(Parts& parts, const Command& command) {
  const auto found = parts.reals.find(command.integer(0));
  const long first = command.integer_or(1, 1);
  if (found == parts.reals.end() || first < 1 || first > most_reals)
    command.fail("changes no constant of a set that is there", "write RMODIF,set,place,values");
  Command shifted = command;
  shifted.drop(1);
  set_reals(shifted, found->second, static_cast<std::size_t>(first));
}

void read_property(Parts& parts, const Command& command) {
  const std::string label = command.word(0);
  for (std::size_t i = 3; is_mechanical(label) && i < command.fields.size(); ++i)
    if (command.number_or(i, 0.0) != 0.0)
      command.fail(label + " depends on temperature, which is not supported", "give it at one temperature");
  if (!is_mechanical(label)) return set_property(parts, command, label, 1, 0.0);
  set_property(parts, command, label, command.integer_or(1, 1), command.number_or(2, 0.0));
}

void read_property_data(Parts& parts, const Command& command) {
  // MPDATA,label,material,place,values, or in archives MPDATA,R5.0,count,label,material,place,values.
  const std::size_t at = command.word(0).starts_with("R5.") || command.word(0) == "UNBL" ? 2 : 0;
  const std::string label = command.word(at);
  if (!is_mechanical(label)) return set_property(parts, command, label, 1, 0.0);
  const long material = command.integer_or(at + 1, 1), place = command.integer_or(at + 2, 1);
  const double first = place > 1 ? parts.materials[material][label].value : command.number(at + 3);
  for (std::size_t i = at + 3; i < command.fields.size(); ++i)
    if (!command.blank(i) && command.number(i) != first)
      command.fail(label + " depends on temperature, which is not supported", "give it at one temperature");
  set_property(parts, command, label, material, first);
}

void read_section_type(Parts& parts, const Command& command) {
  parts.section = command.integer(0);
  SectionDefinition section{.type = command.word(1), .subtype = command.word(2), .name = command.text(3), .line = command.line};
  parts.sections[parts.section] = section;
}

void read_section_data(Parts& parts, const Command& command) {
  SectionDefinition& section = current_section(parts, command);
  std::vector<double> row;
  for (std::size_t i = 0; i < command.fields.size(); ++i) row.push_back(command.number_or(i, 0.0));
  section.data.push_back(row);
}

void read_section_offset(Parts& parts, const Command& command) {
  SectionDefinition& section = current_section(parts, command);
  section.offset = command.word(0).substr(0, 4);
  section.offset_m = {command.number_or(1, 0.0), command.number_or(2, 0.0)};
}

void read_section_control(Parts& parts, const Command& command) {
  // Beams: shear stiffnesses, mass per length; links: mass per length, tension or compression only; shells: shear stiffnesses,
  // mass per area, factors of hourglass and drilling stiffness, which archives write as their default 1.
  const SectionDefinition& section = current_section(parts, command);
  const bool link = section.type.starts_with("LINK"), shell = section.type.starts_with("SHEL");
  for (std::size_t i = 0; i < command.fields.size(); ++i) {
    if (const double value = command.number_or(i, 0.0); value == 0.0 || (shell && i > 3 && value == 1.0)) continue;
    if (link && i == 1) {
      parts.note_once("LINK180 of tension or compression only is read as a bar that takes both");
      continue;
    }
    command.fail(fmt::format("field {} overrides a stiffness of the section or adds mass, which is not supported", i + 1),
                 "leave it blank and give the section as ASEC, the mass as MASS21 or density");
  }
}

}  // namespace twindeck::model_io::ansys
