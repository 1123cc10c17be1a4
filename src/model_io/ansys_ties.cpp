#include "model_io/ansys_ties.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "model_io/rigid_arm.hpp"

/// CDWRITE writes rigid regions as equations, so that those of two nodes are compared with a rigid link.
namespace twindeck::model_io::ansys {
namespace {

using Tied = std::array<bool, 6>;

void read_terms(Parts& parts, const Command& command, Equation& equation, std::size_t first) {
  static const std::vector<std::string> labels = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};
  for (std::size_t i = first; i < command.fields.size(); i += 3) {
    if (command.blank(i)) continue;
    const auto label = std::find(labels.begin(), labels.end(), command.word(i + 1));
    if (label == labels.end())
      parts.fail(command, fmt::format("'{}' is no degree of freedom of a structure", command.word(i + 1)),
                 "expected UX, UY, UZ, ROTX, ROTY or ROTZ");
    const double factor = parts.number(command, i + 2);
    if (factor != 0.0) equation.terms.push_back({parts.integer(command, i), static_cast<int>(label - labels.begin()), factor});
  }
}

/// Whether an equation says what the slave does as part of the master; `tied` is the slave's degree of freedom.
bool is_of_rigid_link(const Equation& equation, long slave, const Eigen::Vector3d& arm, int& tied) {
  constexpr double rounding = 1e-6;  // of coefficients that are printed with nine digits
  double own = 0.0;
  int count = 0;
  for (const Equation::Term& term : equation.terms) {
    if (term.node != slave) continue;
    own = term.factor;
    tied = term.dof;
    ++count;
  }
  if (count != 1) return false;
  std::array<double, 6> factors{};
  for (const Equation::Term& term : equation.terms) {
    if (term.node != slave) factors[static_cast<std::size_t>(term.dof)] -= term.factor / own;
  }
  for (int from = 0; from < 6; ++from) {
    if (std::abs(factors[static_cast<std::size_t>(from)] - rigid_arm_factor(arm, tied, from)) > rounding * (1.0 + arm.norm()))
      return false;
  }
  return true;
}

bool is_whole(const Builder& builder, const Tied& tied, long slave) {
  return tied[0] && tied[1] && tied[2] && ((tied[3] && tied[4] && tied[5]) || !builder.turning.contains(slave));
}

/// Links as they are found, and everything else as equations that are settled at the end.
class Ties {
 public:
  explicit Ties(Builder& builder) : builder_(builder) {
    for (const fe::RigidLink& link : builder.parts.model.links) slaves_.insert(link.slave);
  }

  void link(long master, long slave) {
    builder_.add_link(master, slave);
    slaves_.insert(builder_.node(slave));
  }

  /// The slave moves with the master in some directions: at the end of a rigid arm, or as equal displacements.
  void follow(const char* command, long line, long master, long slave, const Tied& tied, bool with_arm) {
    require_plain(command, line, master);
    require_plain(command, line, slave);
    const Eigen::Vector3d arm = place(slave) - place(master);
    for (int d = 0; d < 6; ++d) {
      if (!tied[static_cast<std::size_t>(d)]) continue;
      Equation equation{0, line, {{slave, d, 1.0}}};
      for (int from = 0; from < 6; ++from) {
        const double factor = with_arm ? rigid_arm_factor(arm, d, from) : from == d ? 1.0 : 0.0;
        if (factor != 0.0) equation.terms.push_back({master, from, -factor});
      }
      pending_.emplace_back(command, equation);
    }
  }

  void add(const Equation& equation) {
    for (const Equation::Term& term : equation.terms) require_plain("CE", equation.line, term.node);
    pending_.emplace_back("CE", equation);
  }

  void settle() {
    for (const auto& [command, equation] : pending_) settle(command, equation);
  }

  /// @throws InputError  for a node that is not in the model or whose axes are turned
  void require_plain(const char* command, long line, long id) const {
    if (!builder_.has_node(id))
      builder_.parts.fail(line, command, fmt::format("ties node {}, which no element holds", id), "leave it out");
    if (builder_.parts.nodes.at(id).rotated)
      builder_.parts.fail(line, command, fmt::format("ties along the axes of node {}, which are turned", id),
                          "turned nodal axes are not supported: give the node global axes");
  }

  [[nodiscard]] const Eigen::Vector3d& place(long id) const { return builder_.parts.nodes.at(id).x_m; }

 private:
  [[nodiscard]] bool held(long id, int dof) const {
    const auto hold = builder_.parts.holds.find(id);
    const bool out_of_plane = dof == 2 || dof == 3 || dof == 4;
    return (hold != builder_.parts.holds.end() && hold->second.fixed[static_cast<std::size_t>(dof)]) ||
           (out_of_plane && builder_.in_plane.contains(id));
  }

  void settle(const char* command, const Equation& equation) {
    std::map<std::pair<int, int>, double> sum;  // node, direction
    std::vector<std::pair<int, int>> order;
    std::map<std::pair<int, int>, long> name;
    for (const Equation::Term& term : equation.terms) {
      if (held(term.node, term.dof)) continue;
      const std::pair at{builder_.node(term.node), term.dof};
      if (sum.emplace(at, 0.0).second) order.push_back(at);
      sum[at] += term.factor;
      name.emplace(at, term.node);
    }
    constexpr double nothing = 1e-12;  // terms that cancel out
    std::erase_if(order, [&](const auto& at) { return std::abs(sum[at]) < nothing; });
    if (order.empty()) return;
    const auto slave = std::find_if(order.begin(), order.end(),
                                    [&](const auto& at) { return !slaves_.contains(at.first) && !dependent_.contains(at); });
    if (slave == order.end())
      builder_.parts.fail(equation.line, command, "ties displacements that all follow others already",
                          "take out one of the ties, or tie the node that the others follow");
    if (order.size() == 1) {  // all others are held
      Hold& hold = builder_.parts.holds[name.at(*slave)];
      if (hold.line == 0) hold.line = equation.line;
      hold.fixed[static_cast<std::size_t>(slave->second)] = true;
      return;
    }
    dependent_.insert(*slave);
    fe::Constraint c{
        fmt::format("{}_{}", command, builder_.parts.model.constraints.size() + 1), slave->first, slave->second, {}};
    for (const auto& at : order) {
      if (at != *slave) c.terms.push_back({at.first, at.second, -sum[at] / sum[*slave]});
    }
    builder_.parts.model.constraints.push_back(c);
  }

  Builder& builder_;
  std::set<int> slaves_;                     ///< of links
  std::set<std::pair<int, int>> dependent_;  ///< node, direction
  std::vector<std::pair<const char*, Equation>> pending_;
};

void add_rigid_regions(Builder& builder, Ties& ties) {
  for (const Link& region : builder.parts.links) {
    if (is_whole(builder, region.tied, region.slave))
      ties.link(region.master, region.slave);
    else
      ties.follow("CERIG", region.line, region.master, region.slave, region.tied, true);
  }
}

/// CP of all displacements of nodes at one place is a rigid link without length.
void add_couples(Builder& builder, Ties& ties) {
  const Parts& parts = builder.parts;
  std::map<std::vector<long>, std::pair<Tied, long>> tied_of_nodes;  // and the line
  for (const auto& [set, couples] : parts.couples) {
    std::map<int, std::pair<std::set<long>, long>> by_dof;  // lines that go on with a set add to it
    for (const Couple& couple : couples) {
      by_dof[couple.dof].first.insert(couple.nodes.begin(), couple.nodes.end());
      by_dof[couple.dof].second = couple.line;
    }
    for (const auto& [dof, nodes] : by_dof) {
      auto& [tied, line] = tied_of_nodes[{nodes.first.begin(), nodes.first.end()}];
      tied[static_cast<std::size_t>(dof)] = true;
      line = nodes.second;
    }
  }
  for (const auto& [nodes, tie] : tied_of_nodes) {
    const auto& [tied, line] = tie;
    if (nodes.size() < 2) parts.fail(line, "CP", "ties less than two nodes", "name the nodes of the set");
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      ties.require_plain("CP", line, nodes[0]);
      ties.require_plain("CP", line, nodes[i]);
      constexpr double one_place = 1e-6;  // of the distance from the origin
      const Eigen::Vector3d& first = ties.place(nodes[0]);
      const bool together = (first - ties.place(nodes[i])).norm() <= one_place * (1.0 + first.norm());
      if (together && is_whole(builder, tied, nodes[i]))
        ties.link(nodes[0], nodes[i]);
      else
        ties.follow("CP", line, nodes[0], nodes[i], tied, false);
    }
  }
}

/// Whether all equations of two nodes make one the slave of the other.
bool is_rigid_link(const Builder& builder, const std::vector<const Equation*>& equations, long master, long slave) {
  const Eigen::Vector3d arm = builder.parts.nodes.at(slave).x_m - builder.parts.nodes.at(master).x_m;
  Tied tied{};
  for (const Equation* equation : equations) {
    int dof = 0;
    if (!is_of_rigid_link(*equation, slave, arm, dof)) return false;
    tied[static_cast<std::size_t>(dof)] = true;
  }
  return is_whole(builder, tied, slave);
}

void add_equations(Builder& builder, Ties& ties) {
  const Parts& parts = builder.parts;
  std::map<std::pair<long, long>, std::vector<const Equation*>> by_nodes;
  for (const Equation& equation : parts.equations) {
    std::set<long> nodes;
    for (const Equation::Term& term : equation.terms) nodes.insert(term.node);
    const auto turned = [&](long id) { return parts.nodes.at(id).rotated; };
    if (nodes.size() != 2 || std::any_of(nodes.begin(), nodes.end(), turned))
      ties.add(equation);
    else
      by_nodes[{*nodes.begin(), *nodes.rbegin()}].push_back(&equation);
  }
  for (const auto& [nodes, equations] : by_nodes) {
    long slave = equations.front()->terms.front().node, master = slave == nodes.first ? nodes.second : nodes.first;
    if (!is_rigid_link(builder, equations, master, slave)) std::swap(slave, master);
    if (is_rigid_link(builder, equations, master, slave)) {
      ties.link(master, slave);
      continue;
    }
    for (const Equation* equation : equations) ties.add(*equation);
  }
}

}  // namespace

void read_equation(Parts& parts, const Command& command) {
  // CE,R5.0,DEFI,number,terms,constant and CE,R5.0,NODE,node,label,factor,…; or CE,number,constant,node,label,factor,…
  const bool archived = command.word(0).starts_with("R5.");
  if (archived && command.word(1) == "NODE") {
    if (parts.equations.empty()) parts.fail(command, "stands before its DEFI line", "check the archive");
    return read_terms(parts, command, parts.equations.back(), 2);
  }
  if (archived && command.word(1) != "DEFI") parts.fail(command, "is neither DEFI nor NODE", "check the archive");
  const long id = parts.integer(command, archived ? 2 : 0);
  if (parts.number_or(command, archived ? 4 : 1, 0.0) != 0.0)
    parts.fail(command, "has a constant that is not 0, which is not supported",
               "prescribed displacements are no part of modes: leave the constant out");
  if (archived || parts.equations.empty() || parts.equations.back().id != id) parts.equations.push_back({id, command.line, {}});
  if (!archived) read_terms(parts, command, parts.equations.back(), 2);
}

void add_ties(Builder& builder) {
  Ties ties(builder);
  add_rigid_regions(builder, ties);
  add_couples(builder, ties);
  add_equations(builder, ties);
  ties.settle();
}

}  // namespace twindeck::model_io::ansys
