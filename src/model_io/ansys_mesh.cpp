#include "model_io/ansys_mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
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

constexpr long most_copies = 1'000'000;  ///< of one command: more is a slip of the pen

const Node& known_node(Parts& parts, const Command& command, long id) {
  const auto found = parts.nodes.find(id);
  if (found == parts.nodes.end())
    command.fail(fmt::format("node {} is not defined", id), "define it before, or correct the number");
  return found->second;
}

long copies_of(const Command& command, std::size_t field) {
  const long copies = command.integer_or(field, 1);
  if (copies < 1 || copies > most_copies)
    command.fail(fmt::format("{} is no number of copies", copies), "give how often it is repeated, the first included");
  return copies;
}

void require_global_axes(Parts& parts, const Command& command) {
  if (parts.own_axes)
    command.fail("stands where CSYS is not 0, and other axes are not supported", "repeat in global Cartesian axes");
}

void refuse_ratio(const Command& command, std::size_t field) {
  if (const double ratio = command.number_or(field, 1.0); ratio != 1.0 && ratio != 0.0)
    command.fail(fmt::format("has a spacing ratio of {:g}, which is not supported", ratio), "space nodes evenly");
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

void fill_nodes(Parts& parts, const Command& command) {
  // FILL,node1,node2,number,first,step,times,increment,ratio
  require_global_axes(parts, command);
  refuse_ratio(command, 7);
  const long from = command.integer_or(0, parts.last_nodes[0]), to = command.integer_or(1, parts.last_nodes[1]);
  const long count = command.integer_or(2, std::abs(to - from) - 1);
  if (count < 0 || count > most_copies)
    command.fail(fmt::format("fills in {} nodes", count), "give two nodes with a gap between, and how many fill it");
  if (count == 0) return;
  const long step = command.integer_or(4, (to - from) / (count + 1));
  const long first = command.integer_or(3, from + step), times = copies_of(command, 5);
  const long increment = command.integer_or(6, 0);
  for (long copy = 0; copy < times; ++copy) {
    const Eigen::Vector3d a = known_node(parts, command, from + copy * increment).x_m,
                          b = known_node(parts, command, to + copy * increment).x_m;
    for (long i = 1; i <= count; ++i)
      add_node(parts, first + (i - 1) * step + copy * increment,
               {a + (b - a) * (static_cast<double>(i) / static_cast<double>(count + 1)), false});
  }
}

void generate_nodes(Parts& parts, const Command& command) {
  // NGEN,times,increment,node1,node2,step,dx,dy,dz,ratio
  require_global_axes(parts, command);
  refuse_ratio(command, 8);
  const long times = copies_of(command, 0), increment = command.integer(1);
  Command range = command;
  range.fields.erase(range.fields.begin(), range.fields.begin() + 2);
  if (range.fields.size() > 3) range.fields.resize(3);
  Eigen::Vector3d shift;
  for (std::size_t i = 0; i < 3; ++i) shift[static_cast<int>(i)] = command.number_or(5 + i, 0.0);
  for (const long id : parts.nodes_of(range, 0, 1)) {
    const Node original = parts.nodes.at(id);
    for (long copy = 1; copy < times; ++copy)
      add_node(parts, id + copy * increment, {original.x_m + static_cast<double>(copy) * shift, original.rotated});
  }
}

void generate_elements(Parts& parts, const Command& command) {
  // EGEN,times,node increment,element1,element2,step,material,type,real,axes,section; element1 < 0: the last so many
  const long times = copies_of(command, 0), increment = command.integer(1);
  std::vector<long> ids;
  const long first = command.word(2) == "ALL" ? 0 : command.integer_or(2, -1);
  if (first > 0) {
    const long last = std::max(first, command.integer_or(3, first)), step = std::max(1L, command.integer_or(4, 1));
    for (long id = first; id <= last; id += step)
      if (parts.elements.contains(id)) ids.push_back(id);
  } else {
    for (const auto& [id, element] : parts.elements) ids.push_back(id);
    if (first < 0 && std::ssize(ids) > -first) ids.erase(ids.begin(), ids.end() + first);
  }
  if (ids.empty()) command.fail("repeats no element", "name elements that are defined");
  for (long copy = 1; copy < times; ++copy)
    for (const long id : ids) {
      Element element = parts.elements.at(id);
      element.line = command.line;
      for (long& node : element.nodes) node += node == 0 ? 0 : copy * increment;
      element.material += copy * command.integer_or(5, 0);
      element.type += copy * command.integer_or(6, 0);
      element.real += copy * command.integer_or(7, 0);
      element.section += copy * command.integer_or(9, 0);
      add_element(parts, parts.elements.rbegin()->first + 1, element);
    }
}

void read_more_nodes(Parts& parts, const Command& command) {
  constexpr std::size_t of_e = 8;  // nodes that E holds
  if (parts.elements.empty()) command.fail("stands before any E", "give E with the first eight nodes before it");
  Element& element = parts.elements.rbegin()->second;
  if (element.nodes.size() < of_e) element.nodes.resize(of_e, 0);
  for (std::size_t i = 0; i < command.fields.size(); ++i) element.nodes.push_back(command.integer_or(i, 0));
  while (!element.nodes.empty() && element.nodes.back() == 0) element.nodes.pop_back();
}

}  // namespace twindeck::model_io::ansys
