#include "model_io/ansys_supports.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "model_io/names.hpp"

/// Supports and ties of nodes.
namespace twindeck::model_io::ansys {
namespace {

/// Degrees of freedom of a label: one, or all six; none for another word.
std::vector<int> dofs_of(const std::string& label) {
  if (label == "ALL") return {0, 1, 2, 3, 4, 5};
  const int dof = position_of(label, dof_labels);
  return dof < 0 ? std::vector<int>{} : std::vector<int>{dof};
}

std::vector<int> known_dofs(const Command& command, std::size_t field) {
  const std::vector<int> dofs = dofs_of(command.word(field));
  if (dofs.empty())
    command.fail(fmt::format("'{}' is no degree of freedom of a structure", command.blank(field) ? "" : command.fields[field]),
                 "expected UX, UY, UZ, ROTX, ROTY, ROTZ or ALL");
  return dofs;
}

void hold(Parts& parts, const Command& command, long node, const std::vector<int>& dofs, const std::string& name) {
  Hold& held = parts.holds[node];
  if (held.line == 0) held = {{}, name, command.line};
  for (const int dof : dofs) held.fixed[static_cast<std::size_t>(dof)] = true;
}

}  // namespace

void read_support(Parts& parts, const Command& command) {
  // D,node,label,value,value2,end,step,label2 … label6
  constexpr std::size_t first_more = 6, last_more = 10;
  if (command.number_or(3, 0.0) != 0.0)
    command.fail("prescribes an imaginary displacement, which is not supported", "supports hold at zero");
  const double size = command.number_or(2, 0.0);
  std::vector<int> dofs = known_dofs(command, 1);
  for (std::size_t i = first_more; i <= last_more; ++i) {
    if (command.blank(i)) continue;
    const std::vector<int> more = known_dofs(command, i);
    dofs.insert(dofs.end(), more.begin(), more.end());
  }
  std::string name;
  if (command.word(0) == "ALL") {
    name = parts.selected_component;
  } else if (const Component* named = command.blank(0) ? nullptr : parts.component(command.fields[0]); named != nullptr) {
    name = named->name;
  }
  for (const long node : parts.nodes_of(command, 0, 4)) {
    hold(parts, command, node, dofs, name);
    for (const int dof : dofs) parts.movements[node][dof] = {size, command.line};
  }
}

void read_released_support(Parts& parts, const Command& command) {
  // DDELE,node,label,end,step
  const std::vector<int> dofs = command.blank(1) ? dofs_of("ALL") : known_dofs(command, 1);
  for (const long node : parts.nodes_of(command, 0, 2)) {
    const auto held = parts.holds.find(node);
    if (held == parts.holds.end()) continue;
    for (const int dof : dofs) {
      held->second.fixed[static_cast<std::size_t>(dof)] = false;
      parts.movements[node].erase(dof);
    }
  }
}

void read_couple(Parts& parts, const Command& command) {
  // CP,set,label,nodes
  const long set = command.integer(0);
  std::set<long> nodes;
  if (command.word(2) == "ALL") {
    nodes = parts.nodes_of(command, 2, 2);
  } else {
    for (std::size_t i = 2; i < command.fields.size(); ++i) {
      if (!command.blank(i)) nodes.insert(command.integer(i));
    }
  }
  for (const int dof : known_dofs(command, 1)) parts.couples[set].push_back({{nodes.begin(), nodes.end()}, dof, command.line});
}

void read_rigid_region(Parts& parts, const Command& command) {
  // CERIG,master,slave,label,label2 … label5: ALL six, UXYZ, RXYZ, or single ones
  std::array<bool, 6> tied{};
  for (std::size_t i = 2; i < std::max<std::size_t>(command.fields.size(), 3); ++i) {
    if (command.blank(i) && i > 2) continue;
    const std::string label = command.blank(i) ? "ALL" : command.word(i);
    for (std::size_t d = 0; d < 3 && (label == "UXYZ" || label == "RXYZ"); ++d) tied[label == "UXYZ" ? d : d + 3] = true;
    if (label == "UXYZ" || label == "RXYZ") continue;
    for (const int dof : dofs_of(label)) tied[static_cast<std::size_t>(dof)] = true;
    if (dofs_of(label).empty())
      command.fail(fmt::format("'{}' is no degree of freedom of a structure", label),
                   "expected ALL, UXYZ, RXYZ, UX, UY, UZ, ROTX, ROTY or ROTZ");
  }
  constexpr std::size_t past_labels = 7;  // a field that the command does not have: one node, no range
  const long master = command.integer(0);
  for (const long slave : parts.nodes_of(command, 1, past_labels)) {
    if (slave != master) parts.links.push_back({master, slave, command.line, tied});
  }
}

}  // namespace twindeck::model_io::ansys
