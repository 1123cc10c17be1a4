#include "model_io/ansys_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace twindeck::model_io::ansys {
const Component* Parts::component(const std::string& name) const {
  const auto found = std::find_if(components.begin(), components.end(),
                                  [&](const Component& c) { return upper_case(c.name) == upper_case(name); });
  return found == components.end() ? nullptr : &*found;
}

std::set<long> Parts::nodes_of(const Command& command, std::size_t field, std::size_t end_field) const {
  std::set<long> chosen;
  if (command.word(field) == "ALL") {
    for (const auto& [id, node] : nodes) {
      if (selected_nodes.has(id)) chosen.insert(id);
    }
    return chosen;
  }
  if (!command.blank(field)) {
    if (const Component* named = component(command.fields[field]); named != nullptr && named->of_nodes) return named->members;
  }
  const long first = command.integer(field), last = std::max(first, command.integer_or(end_field, first));
  const long step = command.integer_or(end_field + 1, 1);
  if (step < 1) command.fail(fmt::format("step {} is no step from node to node", step), "give 1 or more");
  if (first == last && !nodes.contains(first))
    command.fail(fmt::format("node {} is not defined", first), "define it before, or correct the number");
  for (auto it = nodes.lower_bound(first); it != nodes.end() && it->first <= last; ++it) {
    if ((it->first - first) % step == 0 && selected_nodes.has(it->first)) chosen.insert(it->first);
  }
  return chosen;
}

}  // namespace twindeck::model_io::ansys
