#include "model_io/ansys_supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "model_io/deck_model.hpp"
#include "model_io/names.hpp"

/// Supports and ties of nodes. CDWRITE writes rigid regions as equations, so that those of two nodes are compared with a rigid
/// link.
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
  for (const int dof : dofs) held.fixed[fe::slot(dof)] = true;
}

void read_terms(const Command& command, Equation& equation, std::size_t first) {
  for (std::size_t i = first; i < command.fields.size(); i += 3) {
    if (command.blank(i)) continue;
    const int dof = position_of(command.word(i + 1), dof_labels);
    if (dof < 0)
      command.fail(fmt::format("'{}' is no degree of freedom of a structure", command.word(i + 1)),
                   "expected UX, UY, UZ, ROTX, ROTY or ROTZ");
    const double factor = command.number(i + 2);
    if (factor != 0.0) equation.terms.push_back({command.integer(i), dof, factor});
  }
}

/// Links as they are found, and everything else as equations that are settled at the end.
class Ties {
 public:
  explicit Ties(Builder& builder) : builder_(builder), parts_(builder.parts) {
    for (const fe::RigidLink& link : parts_.model.links) slaves_.insert(link.slave);
  }

  /// A slave that follows another node already, and is as whole as its master, leads it instead.
  void link(int master, int slave, bool equals = false) {
    if (equals && slaves_.contains(slave) && !slaves_.contains(master)) std::swap(master, slave);
    parts_.add_link(master, slave);
    slaves_.insert(slave);
  }

  /// The slave moves with the master in some directions: at the end of a rigid arm, or as equal displacements.
  void follow(const DeckPlace& at, int master, int slave, const Directions& tied, bool with_arm) {
    const Eigen::Vector3d arm = parts_.place(slave) - parts_.place(master);
    for (int d = 0; d < 6; ++d) {
      if (!tied[fe::slot(d)]) continue;
      DeckEquation equation{at, {{slave, d, 1.0}}};
      for (int from = 0; from < 6; ++from) {
        const double factor = with_arm ? rigid_arm_factor(arm, d, from) : from == d ? 1.0 : 0.0;
        if (factor != 0.0) equation.terms.push_back({master, from, -factor});
      }
      pending_.push_back(equation);
    }
  }

  void add(const DeckEquation& equation) { pending_.push_back(equation); }

  void settle() {
    for (const DeckEquation& equation : pending_) settle(equation);
  }

  /// Position of a node that is tied. @throws InputError  for one that is not in the model or whose axes are turned
  [[nodiscard]] int node(const DeckPlace& at, long id) const {
    if (!builder_.has_node(id)) at.fail(fmt::format("ties node {}, which no element holds", id), "leave it out");
    if (parts_.nodes.at(id).rotated())
      at.fail(fmt::format("ties along the axes of node {}, which are turned", id),
              "turned nodal axes are not supported: give the node global axes");
    return builder_.node(id);
  }

 private:
  using Displacement = std::pair<int, int>;  ///< node, direction

  [[nodiscard]] long number(int node) const { return parts_.model.nodes[fe::slot(node)].id; }

  [[nodiscard]] bool held(const fe::Constraint::Term& term) const {
    const auto hold = parts_.holds.find(number(term.node));
    const bool out_of_plane = term.direction == 2 || term.direction == 3 || term.direction == 4;
    return (hold != parts_.holds.end() && hold->second.fixed[fe::slot(term.direction)]) ||
           (out_of_plane && builder_.in_plane.contains(number(term.node)));
  }

  void settle(const DeckEquation& equation) {
    std::map<Displacement, double> sum;
    std::vector<Displacement> order;
    for (const fe::Constraint::Term& term : equation.terms) {
      if (held(term)) continue;
      const Displacement at{term.node, term.direction};
      if (sum.emplace(at, 0.0).second) order.push_back(at);
      sum[at] += term.factor;
    }
    constexpr double nothing = 1e-12;  // terms that cancel out
    std::erase_if(order, [&](const auto& at) { return std::abs(sum[at]) < nothing; });
    if (order.empty()) return;
    const auto slave =
        std::ranges::find_if(order, [&](const auto& at) { return !slaves_.contains(at.first) && !dependent_.contains(at); });
    if (slave == order.end())
      equation.at.fail("ties displacements that all follow others already",
                       "take out one of the ties, or tie the node that the others follow");
    if (order.size() == 1) {  // all others are held
      Hold& hold = parts_.holds[number(slave->first)];
      if (hold.line == 0) hold.line = equation.at.line;
      hold.fixed[fe::slot(slave->second)] = true;
      return;
    }
    dependent_.insert(*slave);
    fe::Constraint c{parts_.numbered(equation.at.label), slave->first, slave->second, {}};
    for (const auto& at : order)
      if (at != *slave) c.terms.push_back({at.first, at.second, -sum[at] / sum[*slave]});
    parts_.add_constraint(c, equation.at);
  }

  Builder& builder_;
  Parts& parts_;
  std::set<int> slaves_;  ///< of links
  std::set<Displacement> dependent_;
  std::vector<DeckEquation> pending_;
};

void add_rigid_regions(Builder& builder, Ties& ties) {
  for (const Link& region : builder.parts.links) {
    const DeckPlace at = builder.parts.at(region.line, "CERIG");
    if (builder.parts.is_whole(region.tied, builder.node(region.slave)))
      ties.link(builder.node(region.master), builder.node(region.slave),
                builder.parts.is_whole(region.tied, builder.node(region.master)));
    else
      ties.follow(at, ties.node(at, region.master), ties.node(at, region.slave), region.tied, true);
  }
}

/// CP of all displacements of nodes at one place is a rigid link without length.
void add_couples(Builder& builder, Ties& ties) {
  Parts& parts = builder.parts;
  std::map<std::vector<long>, std::pair<Directions, long>> tied_of_nodes;  // and the line
  for (const auto& [set, couples] : parts.couples) {
    std::map<int, std::pair<std::set<long>, long>> by_dof;  // lines that go on with a set add to it
    for (const Couple& couple : couples) {
      by_dof[couple.dof].first.insert(couple.nodes.begin(), couple.nodes.end());
      by_dof[couple.dof].second = couple.line;
    }
    for (const auto& [dof, nodes] : by_dof) {
      auto& [tied, line] = tied_of_nodes[{nodes.first.begin(), nodes.first.end()}];
      tied[fe::slot(dof)] = true;
      line = nodes.second;
    }
  }
  for (const auto& [nodes, tie] : tied_of_nodes) {
    const DeckPlace at = parts.at(tie.second, "CP");
    if (nodes.size() < 2) at.fail("ties less than two nodes", "name the nodes of the set");
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const int first = ties.node(at, nodes[0]), other = ties.node(at, nodes[i]);
      if (parts.together(other, first) && parts.is_whole(tie.first, other))
        ties.link(first, other);
      else
        ties.follow(at, first, other, tie.first, false);
    }
  }
}

void add_equations(Builder& builder, Ties& ties) {
  const Parts& parts = builder.parts;
  std::vector<DeckEquation> all;
  std::map<std::pair<long, long>, std::vector<const DeckEquation*>> by_nodes;
  all.reserve(parts.equations.size());
  for (const Equation& equation : parts.equations) {
    std::set<long> nodes;
    DeckEquation& made = all.emplace_back(DeckEquation{equation.at, {}});
    for (const Equation::Term& term : equation.terms) {
      nodes.insert(term.node);
      made.terms.push_back({ties.node(equation.at, term.node), term.dof, term.factor});
    }
    if (nodes.size() == 2)
      by_nodes[{*nodes.begin(), *nodes.rbegin()}].push_back(&made);
    else
      ties.add(made);
  }
  for (const auto& [nodes, equations] : by_nodes) {
    int slave = equations.front()->terms.front().node;
    int master = builder.node(parts.model.nodes[fe::slot(slave)].id == nodes.first ? nodes.second : nodes.first);
    if (!parts.is_rigid_link(equations, master, slave)) std::swap(slave, master);
    if (parts.is_rigid_link(equations, master, slave)) {
      ties.link(master, slave);
      continue;
    }
    for (const DeckEquation* equation : equations) ties.add(*equation);
  }
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

void read_symmetry(Parts& parts, const Command& command) {
  // DSYM,SYMM or ASYM,X, Y or Z: across the plane, the nodes' own motion along it is held, or all other motion
  const int normal = command.blank(1) ? 0 : position_of(command.word(1), {"X", "Y", "Z"});
  const bool symmetric = command.word(0) == "SYMM";
  if ((!symmetric && command.word(0) != "ASYM") || normal < 0 || command.integer_or(2, 0) != 0)
    command.fail("is no plane of symmetry across a global axis", "give SYMM or ASYM and X, Y or Z, in global axes");
  std::vector<int> dofs;
  for (int d = 0; d < 3; ++d) dofs.push_back((d == normal) == symmetric ? d : d + 3);
  for (auto& [id, node] : parts.nodes) {
    if (!parts.selected_nodes.has(id)) continue;
    node.axes.setIdentity();  // as the command turns them
    hold(parts, command, id, dofs, parts.selected_component);
  }
}

void read_released_support(Parts& parts, const Command& command) {
  // DDELE,node,label,end,step
  const std::vector<int> dofs = command.blank(1) ? dofs_of("ALL") : known_dofs(command, 1);
  for (const long node : parts.nodes_of(command, 0, 2)) {
    const auto held = parts.holds.find(node);
    if (held == parts.holds.end()) continue;
    for (const int dof : dofs) {
      held->second.fixed[fe::slot(dof)] = false;
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
    for (std::size_t i = 2; i < command.fields.size(); ++i)
      if (!command.blank(i)) nodes.insert(command.integer(i));
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
    for (const int dof : dofs_of(label)) tied[fe::slot(dof)] = true;
    if (dofs_of(label).empty())
      command.fail(fmt::format("'{}' is no degree of freedom of a structure", label),
                   "expected ALL, UXYZ, RXYZ, UX, UY, UZ, ROTX, ROTY or ROTZ");
  }
  constexpr std::size_t past_labels = 7;  // a field that the command does not have: one node, no range
  const long master = command.integer(0);
  for (const long slave : parts.nodes_of(command, 1, past_labels))
    if (slave != master) parts.links.push_back({master, slave, command.line, tied});
}

void read_equation(Parts& parts, const Command& command) {
  // CE,R5.0,DEFI,number,terms,constant and CE,R5.0,NODE,node,label,factor,…; or CE,number,constant,node,label,factor,…
  const bool archived = command.word(0).starts_with("R5.");
  if (archived && command.word(1) == "NODE") {
    if (parts.equations.empty()) command.fail("stands before its DEFI line", "check the archive");
    return read_terms(command, parts.equations.back(), 2);
  }
  if (archived && command.word(1) != "DEFI") command.fail("is neither DEFI nor NODE", "check the archive");
  const long id = command.integer(archived ? 2 : 0);
  if (command.number_or(archived ? 4 : 1, 0.0) != 0.0)
    command.fail("has a constant that is not 0, which is not supported",
                 "prescribed displacements are no part of modes: leave the constant out");
  if (archived || parts.equations.empty() || parts.equations.back().id != id)
    parts.equations.push_back({id, parts.at(command.line, "CE"), {}});
  if (!archived) read_terms(command, parts.equations.back(), 2);
}

void add_ties(Builder& builder) {
  Ties ties(builder);
  add_rigid_regions(builder, ties);
  add_couples(builder, ties);
  add_equations(builder, ties);
  ties.settle();
}

}  // namespace twindeck::model_io::ansys
