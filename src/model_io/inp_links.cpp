#include "model_io/inp_links.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "model_io/inp_elements.hpp"
#include "model_io/rigid_arm.hpp"

namespace twindeck::model_io {
namespace {

Eigen::Vector3d place(const InpParts& parts, int node) { return parts.model.nodes[static_cast<std::size_t>(node)].x_m; }

/// Whether the equations of a slave make it follow one other node as a rigid body; `turns`: an element holds its rotations.
bool is_rigid_link(const InpParts& parts, const std::vector<const InpEquation*>& equations, bool turns) {
  const InpEquation& first = *equations.front();
  const long master_id = first.terms[1].node;
  const int slave = parts.node(*first.card, first.line, first.terms[0].node),
            master = parts.node(*first.card, first.line, master_id);
  if (slave == master) return false;
  const Eigen::Vector3d r = place(parts, slave) - place(parts, master);
  const double small = 1e-6 * (1.0 + r.norm());
  std::set<int> tied;
  for (const InpEquation* equation : equations) {
    const int to = equation->terms[0].dof;
    const double scale = -equation->terms[0].coefficient;
    std::array<double, 6> factor{};
    for (std::size_t i = 1; i < equation->terms.size(); ++i) {
      const InpEquation::Term& term = equation->terms[i];
      if (term.node != master_id || scale == 0.0) return false;
      factor[static_cast<std::size_t>(term.dof)] += term.coefficient / scale;
    }
    for (int from = 0; from < 6; ++from) {
      if (std::abs(factor[static_cast<std::size_t>(from)] - rigid_arm_factor(r, to, from)) > small) return false;
    }
    tied.insert(to);
  }
  // A slave where only trusses or solids meet has no rotation of its own to tie.
  return tied.contains(0) && tied.contains(1) && tied.contains(2) && tied.size() == equations.size() &&
         (tied.size() == 6 || !turns);
}

/// Any other equation: its first term follows the others.
void add_equation(InpParts& parts, const InpEquation& equation) {
  const InpEquation::Term& slave = equation.terms[0];
  if (slave.coefficient == 0.0)
    parts.file.fail(*equation.card, equation.line, "the coefficient of the first term is 0, so that nothing follows from it",
                    "begin with the displacement that depends on the others");
  fe::Constraint c{fmt::format("equation_{}", parts.model.constraints.size() + 1),
                   parts.node(*equation.card, equation.line, slave.node),
                   slave.dof,
                   {}};
  for (std::size_t i = 1; i < equation.terms.size(); ++i) {
    const InpEquation::Term& term = equation.terms[i];
    if (term.coefficient == 0.0) continue;
    c.terms.push_back({parts.node(*equation.card, equation.line, term.node), term.dof, -term.coefficient / slave.coefficient});
  }
  if (c.terms.empty())
    parts.file.fail(*equation.card, equation.line, "all coefficients but the first are 0",
                    "hold the displacement by *BOUNDARY");
  parts.add_constraint(c, *equation.card, equation.line);
}

/// Supports of slaves are handed to their masters where both lie at one place, or where all six directions are held.
void hold_masters(InpParts& parts) {
  std::map<int, int> master;
  for (const fe::RigidLink& link : parts.model.links) master.emplace(link.slave, link.master);
  auto& supports = parts.model.supports;
  bool moved = true;
  for (std::size_t round = 0; moved && round <= master.size(); ++round) {  // along chains of links
    moved = false;
    for (fe::Support& support : supports) {
      const auto found = master.find(support.node);
      if (found == master.end()) continue;
      const bool whole = std::all_of(support.fixed.begin(), support.fixed.end(), [](bool fixed) { return fixed; });
      const double apart = (place(parts, support.node) - place(parts, found->second)).norm();
      if (!whole && apart > 1e-9 * (1.0 + place(parts, support.node).norm())) continue;  // refused where links are joined
      support.node = found->second;
      moved = true;
    }
  }
  std::vector<fe::Support> merged;
  for (const fe::Support& support : supports) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const fe::Support& s) { return s.node == support.node; });
    if (same == merged.end())
      merged.push_back(support);
    else
      for (std::size_t d = 0; d < 6; ++d) same->fixed[d] = same->fixed[d] || support.fixed[d];
  }
  supports = std::move(merged);
}

/// TIE and PIN: two nodes at one place move alike, with or without their rotations.
void join_alike(InpParts& parts, const InpCard& card, long line, const std::string& type, int slave, int master) {
  if ((place(parts, slave) - place(parts, master)).norm() > 1e-6 * (1.0 + place(parts, master).norm()))
    parts.file.fail(card, line,
                    fmt::format("MPC {} joins two nodes that do not lie at one place, which is not supported", type),
                    "use BEAM, a rigid link");
  if (type == "TIE") return parts.add_link(master, slave);
  for (int d = 0; d < 3; ++d)
    parts.add_constraint({fmt::format("pin_{}", parts.model.constraints.size() + 1), slave, d, {{master, d, 1.0}}}, card, line);
}

}  // namespace

void read_inp_equation(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {});
  if (parts.scopes[static_cast<std::size_t>(parts.scope)].turned())
    parts.file.fail(card, card.line, "stands in an instance that is rotated, where its directions are not sure",
                    "write the equation at the level of the assembly, in global directions");
  for (std::size_t row = 0; row < card.data.size();) {
    InpEquation equation{&card, card.data[row].line, {}};
    const long terms = parts.file.integer(card, card.data[row], 0);
    if (terms < 2 || terms > 1000)
      parts.file.fail(card, equation.line, fmt::format("{} terms are no equation", terms),
                      "give their number, then node, degree of freedom, coefficient of each");
    ++row;
    std::size_t field = 0;
    while (static_cast<long>(equation.terms.size()) < terms) {
      if (row >= card.data.size())
        parts.file.fail(card, equation.line,
                        fmt::format("the equation ends after {} of {} terms", equation.terms.size(), terms), "complete it");
      const InpLine& line = card.data[row];
      const long node = parts.node_id(card, line, field);
      equation.terms.push_back({node, parts.file.dof(card, line, field + 1), parts.file.number(card, line, field + 2)});
      field += 3;
      if (field + 2 >= line.fields.size()) {
        ++row;
        field = 0;
      }
    }
    if (field != 0) ++row;
    parts.equations.push_back(equation);
  }
}

void attach_inp_equations(InpParts& parts) {
  std::map<long, std::vector<const InpEquation*>> by_slave;
  for (const InpEquation& equation : parts.equations) by_slave[equation.terms[0].node].push_back(&equation);
  const std::set<long> turning = parts.turning_nodes();
  for (const auto& [slave_id, equations] : by_slave) {
    const InpEquation& first = *equations.front();
    if (is_rigid_link(parts, equations, turning.contains(slave_id))) {
      parts.add_link(parts.node(*first.card, first.line, first.terms[1].node), parts.node(*first.card, first.line, slave_id));
      continue;
    }
    for (const InpEquation* equation : equations) add_equation(parts, *equation);
  }
}

void attach_inp_rigid_body(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"REF NODE", "NSET", "TIE NSET"});
  const std::string slaves = card.has("TIE NSET") ? card.get("TIE NSET") : parts.file.required(card, "NSET");
  const int master = parts.reference_node(card);
  for (const long id : parts.set(parts.node_sets, card, card.line, slaves).members) {
    if (const int slave = parts.node(card, card.line, id); slave != master) parts.add_link(master, slave);
  }
}

void attach_inp_mpc(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {});
  for (const InpLine& line : card.data) {
    const std::string type = line.fields.empty() ? "" : upper_case(line.fields[0]);
    if (type != "BEAM" && type != "TIE" && type != "PIN")
      parts.file.fail(card, line.line, fmt::format("unsupported MPC type '{}'", type),
                      "BEAM (a rigid link), TIE and PIN (two nodes at one place) are supported");
    const std::vector<long> slaves = parts.nodes_of(card, line, 1), masters = parts.nodes_of(card, line, 2);
    if (masters.size() != 1) parts.file.fail(card, line.line, "names more than one master", "BEAM, slave, master");
    const int master = parts.node(card, line.line, masters.front());
    for (const long id : slaves) {
      const int slave = parts.node(card, line.line, id);
      if (type == "BEAM")
        parts.add_link(master, slave);
      else
        join_alike(parts, card, line.line, type, slave, master);
    }
    if (type == "BEAM") parts.notes.push_back("*MPC of type BEAM is read as Abaqus means it: a rigid link");
  }
}

void settle_inp_constraints(InpParts& parts) {
  hold_masters(parts);
  std::map<int, std::array<bool, 6>> held;
  for (const fe::Support& support : parts.model.supports) held[support.node] = support.fixed;
  const auto is_held = [&](int node, int direction) {
    const auto found = held.find(node);
    return found != held.end() && found->second[static_cast<std::size_t>(direction)];
  };
  std::vector<fe::Constraint> kept;
  std::vector<InpParts::Origin> origins;
  for (std::size_t i = 0; i < parts.model.constraints.size(); ++i) {
    const fe::Constraint& c = parts.model.constraints[i];
    const InpParts::Origin& at = parts.constraint_origin[i];
    if (!is_held(c.node, c.direction)) {
      kept.push_back(c);
      origins.push_back(at);
      continue;
    }
    const bool all_held = std::all_of(c.terms.begin(), c.terms.end(),
                                      [&](const fe::Constraint::Term& term) { return is_held(term.node, term.direction); });
    if (!all_held)
      parts.file.fail(*at.card, at.line,
                      fmt::format("makes node {} follow others in degree of freedom {}, which *BOUNDARY holds",
                                  parts.node_name(parts.model.nodes[static_cast<std::size_t>(c.node)].id), c.direction + 1),
                      "take the node out of the support; what it follows may be held");
  }
  parts.model.constraints = std::move(kept);
  parts.constraint_origin = std::move(origins);
}

}  // namespace twindeck::model_io
