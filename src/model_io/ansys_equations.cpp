#include "model_io/ansys_equations.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "model_io/ansys_build.hpp"

/// Constraint equations. CDWRITE writes rigid regions as such, so that those of two nodes are compared with a rigid link.
namespace twindeck::model_io::ansys {
namespace {

constexpr const char* rigid_or_none =
    "only equations that make one node follow another as a rigid body are read, in all directions";

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

/// Factor of the master's degree of freedom `from` in the slave's `to` at the end of the arm r: u_s = u_m + theta_m × r.
double arm_factor(const Eigen::Vector3d& r, int to, int from) {
  if (to == from) return 1.0;
  if (to > 2 || from < 3) return 0.0;
  return Eigen::Vector3d::Unit(from - 3).cross(r)[to];
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
    if (std::abs(factors[static_cast<std::size_t>(from)] - arm_factor(arm, tied, from)) > rounding * (1.0 + arm.norm()))
      return false;
  }
  return true;
}

/// Whether all equations of two nodes make one the slave of the other.
bool is_rigid_link(const Builder& builder, const std::vector<const Equation*>& equations, long master, long slave) {
  const Eigen::Vector3d arm = builder.parts.nodes.at(slave).x_m - builder.parts.nodes.at(master).x_m;
  std::set<int> tied;
  for (const Equation* equation : equations) {
    int dof = 0;
    if (!is_of_rigid_link(*equation, slave, arm, dof)) return false;
    tied.insert(dof);
  }
  const bool places = tied.contains(0) && tied.contains(1) && tied.contains(2);
  return places && (tied.size() == 6 || !builder.turning.contains(slave));
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
    parts.fail(command, "has a constant that is not 0, which is not supported", rigid_or_none);
  if (archived || parts.equations.empty() || parts.equations.back().id != id) parts.equations.push_back({id, command.line, {}});
  if (!archived) read_terms(parts, command, parts.equations.back(), 2);
}

void add_equations(Builder& builder) {
  const Parts& parts = builder.parts;
  std::map<std::pair<long, long>, std::vector<const Equation*>> by_nodes;
  for (const Equation& equation : parts.equations) {
    std::set<long> nodes;
    for (const Equation::Term& term : equation.terms) nodes.insert(term.node);
    const auto turned = [&](long id) { return parts.nodes.at(id).rotated; };
    if (nodes.size() != 2 || std::any_of(nodes.begin(), nodes.end(), turned))
      parts.fail(equation.line, "CE", fmt::format("equation {} is no part of a rigid link of two nodes", equation.id),
                 rigid_or_none);
    by_nodes[{*nodes.begin(), *nodes.rbegin()}].push_back(&equation);
  }
  for (const auto& [nodes, equations] : by_nodes) {
    const Equation& first = *equations.front();
    long slave = first.terms.front().node, master = slave == nodes.first ? nodes.second : nodes.first;
    if (!is_rigid_link(builder, equations, master, slave)) std::swap(slave, master);
    if (!is_rigid_link(builder, equations, master, slave))
      parts.fail(first.line, "CE", fmt::format("the equations of nodes {} and {} are no rigid link", nodes.first, nodes.second),
                 rigid_or_none);
    builder.add_link(master, slave);
  }
}

}  // namespace twindeck::model_io::ansys
