#include "model_io/ansys_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

/// What is selected, and components, as far as supports and groups rest on it.
namespace twindeck::model_io::ansys {
namespace {

template <class Map>
std::set<long> keys_of(const Map& map) {
  std::set<long> keys;
  for (const auto& [id, what] : map) keys.insert(id);
  return keys;
}

/// S anew, R from what is selected, A also, U not any more.
void combine(const Command& command, Selection& selection, const std::set<long>& everything, const std::set<long>& found) {
  const std::string how = command.word(0).empty() ? "S" : command.word(0);
  std::set<long> before = selection.all ? everything : selection.ids;
  selection.all = false;
  if (how == "S") {
    selection.ids = found;
  } else if (how == "A") {
    before.insert(found.begin(), found.end());
    selection.ids = before;
  } else if (how == "R" || how == "U") {
    std::erase_if(before, [&](long id) { return found.contains(id) == (how == "U"); });
    selection.ids = before;
  } else {
    command.fail(fmt::format("'{}' is no way to select", command.fields[0]), "expected S, R, A, U, ALL, NONE or INVE");
  }
}

/// ALL, NONE, INVE. @return true if that was it
bool select_whole(const Command& command, Selection& selection, const std::set<long>& everything) {
  const std::string how = command.word(0);
  if (how == "ALL" || how == "NONE") {
    selection = {how == "ALL", {}};
    return true;
  }
  if (!how.starts_with("INVE")) return false;
  std::set<long> rest = everything;
  if (selection.all) rest.clear();
  for (const long id : selection.ids) rest.erase(id);
  selection = {false, rest};
  return true;
}

struct Range {
  double first, last;
  long step;
};

Range range_of(const Command& command, std::size_t field) {
  const double first = command.number_or(field, 0.0), last = command.number_or(field + 1, first);
  const long step = command.integer_or(field + 2, 1);
  if (step < 1) command.fail(fmt::format("step {} is no step", step), "give 1 or more");
  return {first, last, step};
}

bool holds(const Range& range, long id) {
  const auto value = static_cast<double>(id);
  return value >= range.first && value <= range.last && std::fmod(value - range.first, static_cast<double>(range.step)) == 0.0;
}

/// Nodes between two coordinates, with the tolerances that the program takes.
std::set<long> nodes_at(Parts& parts, const Command& command) {
  constexpr double of_value = 0.005, of_zero = 1e-6, of_range = 1e-8;
  const std::string axis = command.word(2);
  if (parts.own_axes || (axis != "X" && axis != "Y" && axis != "Z"))
    command.fail("selects by other axes than the global X, Y, Z", "select by those, or by node numbers");
  const Range range = range_of(command, 3);
  const double tolerance = range.first != range.last ? of_range * (range.last - range.first)
                           : range.first != 0.0      ? of_value * std::abs(range.first)
                                                     : of_zero;
  std::set<long> found;
  for (const auto& [id, node] : parts.nodes) {
    const double x = node.x_m[axis[0] - 'X'];
    if (x >= range.first - tolerance && x <= range.last + tolerance) found.insert(id);
  }
  return found;
}

}  // namespace

const Component* Parts::component(const std::string& name) const {
  const auto found =
      std::ranges::find_if(components, [&](const Component& c) { return upper_case(c.name) == upper_case(name); });
  return found == components.end() ? nullptr : &*found;
}

std::set<long> Parts::nodes_of(const Command& command, std::size_t field, std::size_t end_field) const {
  std::set<long> chosen;
  if (command.word(field) == "ALL") {
    for (const auto& [id, node] : nodes)
      if (selected_nodes.has(id)) chosen.insert(id);
    return chosen;
  }
  if (const Component* named = component(command.text(field)); named != nullptr && named->of_nodes) return named->members;
  const long first = command.integer(field), last = std::max(first, command.integer_or(end_field, first));
  const long step = command.integer_or(end_field + 1, 1);
  if (step < 1) command.fail(fmt::format("step {} is no step from node to node", step), "give 1 or more");
  if (first == last && !nodes.contains(first))
    command.fail(fmt::format("node {} is not defined", first), "define it before, or correct the number");
  for (auto it = nodes.lower_bound(first); it != nodes.end() && it->first <= last; ++it)
    if ((it->first - first) % step == 0 && selected_nodes.has(it->first)) chosen.insert(it->first);
  return chosen;
}

void read_component(Parts& parts, const Command& command) {
  const std::string entity = command.word(1);
  if (command.blank(0)) command.fail("has no name", "write CM,name,NODE or CM,name,ELEM");
  if (entity != "NODE" && !entity.starts_with("ELEM")) return;  // geometry
  Component component{command.fields[0], entity == "NODE", {}};
  const Selection& selection = component.of_nodes ? parts.selected_nodes : parts.selected_elements;
  component.members = !selection.all ? selection.ids : component.of_nodes ? keys_of(parts.nodes) : keys_of(parts.elements);
  parts.components.push_back(component);
}

void select_component(Parts& parts, const Command& command) {
  parts.selected_component.clear();
  if (command.word(0) == "ALL") return select_all(parts, command);
  if (command.blank(1)) command.fail("names no component", "write CMSEL,S,name");
  const Component* named = parts.component(command.fields[1]);
  if (named == nullptr)
    command.fail(fmt::format("no component is called '{}'", command.fields[1]), "define it by CMBLOCK or CM before");
  if (named->of_nodes) {
    combine(command, parts.selected_nodes, keys_of(parts.nodes), named->members);
    if (command.word(0) == "S" || command.word(0).empty()) parts.selected_component = named->name;
  } else {
    combine(command, parts.selected_elements, keys_of(parts.elements), named->members);
  }
}

void select_nodes(Parts& parts, const Command& command) {
  parts.selected_component.clear();
  const std::set<long> everything = keys_of(parts.nodes);
  if (select_whole(command, parts.selected_nodes, everything)) return;
  std::set<long> found;
  if (command.word(1) == "LOC") {
    found = nodes_at(parts, command);
  } else if ((command.word(1) == "NODE" || command.blank(1)) && command.blank(2)) {
    const Range range = range_of(command, 3);
    for (const long id : everything)
      if (holds(range, id)) found.insert(id);
  } else {
    command.fail(fmt::format("selection by '{}' is not supported", command.fields[1]),
                 "select by NODE or LOC, or write a component");
  }
  combine(command, parts.selected_nodes, everything, found);
}

void select_elements(Parts& parts, const Command& command) {
  const std::set<long> everything = keys_of(parts.elements);
  if (select_whole(command, parts.selected_elements, everything)) return;
  const std::string by = command.word(1);
  const Range range = range_of(command, 3);
  std::set<long> found;
  for (const auto& [id, element] : parts.elements) {
    const long value = by.empty() || by.starts_with("ELEM") ? id
                       : by == "TYPE"                       ? element.type
                       : by == "MAT"                        ? element.material
                       : by == "REAL"                       ? element.real
                       : by.starts_with("SEC")              ? element.section
                                                            : -1;
    if (value < 0)
      command.fail(fmt::format("selection by '{}' is not supported", command.fields[1]),
                   "select by ELEM, TYPE, MAT, REAL or SEC, or write a component");
    if (holds(range, value)) found.insert(id);
  }
  combine(command, parts.selected_elements, everything, found);
}

void select_nodes_of_elements(Parts& parts, const Command& command) {
  parts.selected_component.clear();
  std::set<long> found;
  for (const auto& [id, element] : parts.elements)
    if (parts.selected_elements.has(id)) found.insert(element.nodes.begin(), element.nodes.end());
  found.erase(0);
  combine(command, parts.selected_nodes, keys_of(parts.nodes), found);
}

void select_all(Parts& parts, const Command& /*command*/) {
  parts.selected_component.clear();
  parts.selected_nodes = parts.selected_elements = {};
}

}  // namespace twindeck::model_io::ansys
