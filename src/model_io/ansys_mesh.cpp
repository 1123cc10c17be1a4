#include "model_io/ansys_mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "core/error.hpp"

/// Nodes and elements, one command each.
namespace twindeck::model_io::ansys {
namespace {

/// N,R5.3,LOC,node,x,y,z, or N,UNBL,LOC,…: how an archive without blocks writes them; node -1 ends a block.
bool read_archived_node(Parts& parts, const Command& command) {
  if (!command.word(0).starts_with("R5.") && command.word(0) != "UNBL") return false;
  const long id = command.integer(2);
  if (id < 1) return true;
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < 3; ++i) values[i] = command.number_or(i + 3, 0.0);
  if (command.word(1) == "LOC") {
    add_node(parts, id, {Eigen::Vector3d(values[0], values[1], values[2]), false});
  } else if (command.word(1) == "ANG") {
    const auto found = parts.nodes.find(id);
    if (found == parts.nodes.end()) command.fail(fmt::format("node {} is not defined", id), "give its LOC line before");
    found->second.rotated = values != std::array<double, 3>{};
  } else {
    command.fail(fmt::format("'{}' is neither LOC nor ANG", command.fields[1]), "check the archive");
  }
  return true;
}

}  // namespace

void add_node(Parts& parts, long id, const Node& node) {
  parts.nodes[id] = node;
  if (!parts.selected_nodes.all) parts.selected_nodes.ids.insert(id);
}

void add_element(Parts& parts, long id, Element element) {
  parts.elements[id] = std::move(element);
  if (!parts.selected_elements.all) parts.selected_elements.ids.insert(id);
}

void read_node(Parts& parts, const Command& command) {
  if (read_archived_node(parts, command)) return;
  if (parts.own_axes)
    command.fail("stands where CSYS is not 0, and other axes are not supported", "give nodes in global Cartesian axes");
  const long id = command.integer_or(0, parts.nodes.empty() ? 1 : parts.nodes.rbegin()->first + 1);
  if (id < 1) command.fail(fmt::format("{} is no node number", id), "give 1 or more");
  Node node;
  for (std::size_t i = 0; i < 3; ++i) node.x_m[static_cast<int>(i)] = command.number_or(i + 1, 0.0);
  for (std::size_t i = 4; i < 7; ++i) node.rotated = node.rotated || command.number_or(i, 0.0) != 0.0;
  add_node(parts, id, node);
  parts.last_nodes = {parts.last_nodes[1], id};
}

void read_element(Parts& parts, const Command& command) {
  Element element = parts.active;
  element.line = command.line;
  for (std::size_t i = 0; i < command.fields.size(); ++i) element.nodes.push_back(command.integer_or(i, 0));
  while (!element.nodes.empty() && element.nodes.back() == 0) element.nodes.pop_back();
  add_element(parts, parts.elements.empty() ? 1 : parts.elements.rbegin()->first + 1, element);
}

void read_numbered_element(Parts& parts, const Command& command) {
  if (command.word(0).starts_with("R5.") || command.word(0) == "UNBL")
    command.fail("elements of an archive without blocks are not read", "write it by CDWRITE with the option BLOCKED");
  const long id = command.integer(0);
  if (id < 1) command.fail(fmt::format("{} is no element number", id), "give 1 or more");
  Command rest = command;
  rest.fields.erase(rest.fields.begin());
  Element element = parts.active;
  element.line = command.line;
  for (std::size_t i = 0; i < rest.fields.size(); ++i) element.nodes.push_back(rest.integer_or(i, 0));
  while (!element.nodes.empty() && element.nodes.back() == 0) element.nodes.pop_back();
  add_element(parts, id, element);
}

void read_attribute(Parts& parts, const Command& command) {
  const long value = command.integer_or(0, 1);
  (command.key == "TYPE"   ? parts.active.type
   : command.key == "MAT"  ? parts.active.material
   : command.key == "REAL" ? parts.active.real
                           : parts.active.section) = value;
}

void read_axes(Parts& parts, const Command& command) {
  // LOCAL, CLOCAL and CS make the axes that they define the active ones.
  parts.own_axes = command.key != "CSYS" || command.integer_or(0, 0) != 0;
}

}  // namespace twindeck::model_io::ansys
