#include "model_io/inp_links.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "model_io/inp_elements.hpp"
#include "model_io/inp_parts.hpp"

namespace twindeck::model_io {
namespace {

Eigen::Vector3d place(const InpParts& parts, int node) { return parts.model.nodes[static_cast<std::size_t>(node)].x_m; }

[[noreturn]] void no_rigid_link(const InpParts& parts, const InpEquation& equation) {
  parts.file.fail(*equation.card, equation.line,
                  fmt::format("the equations of node {} are no rigid link to one other node, and nothing else is supported",
                              equation.terms[0].node),
                  "u_s = u_m + theta_m x (x_s - x_m), theta_s = theta_m; or model the joint by a stiff element");
}

/// Factor of the master's degree of freedom `from` (0-5) in the slave's `to`, as a rigid body of arm r.
double rigid_factor(const Eigen::Vector3d& r, int to, int from) {
  if (to == from) return 1.0;
  if (to > 2 || from < 3) return 0.0;
  return Eigen::Vector3d::Unit(from - 3).cross(r)[to];
}

/// Nodes whose rotations an element holds.
std::set<long> turning_nodes(const InpParts& parts) {
  std::set<long> nodes;
  for (const auto& [id, element] : parts.elements) {
    const InpKind kind = inp_kind(element.type);
    if (kind == InpKind::beam || kind == InpKind::shell) nodes.insert(element.nodes.begin(), element.nodes.end());
  }
  return nodes;
}

void add_link(InpParts& parts, int master, int slave) {
  parts.model.links.push_back({fmt::format("link_{}", parts.model.links.size() + 1), master, slave});
}

}  // namespace

void read_inp_equation(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {});
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
      const long node = parts.file.integer(card, line, field), dof = parts.file.integer(card, line, field + 1);
      if (dof < 1 || dof > 6)
        parts.file.fail(card, line.line, fmt::format("degree of freedom {} is not supported, expected 1 to 6", dof),
                        "1-3 displacements, 4-6 rotations");
      equation.terms.push_back({node, static_cast<int>(dof) - 1, parts.file.number(card, line, field + 2)});
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
  const std::set<long> turning = turning_nodes(parts);
  for (const auto& [slave_id, equations] : by_slave) {
    const InpEquation& first = *equations.front();
    const long master_id = first.terms[1].node;
    const int slave = parts.node(*first.card, first.line, slave_id), master = parts.node(*first.card, first.line, master_id);
    const Eigen::Vector3d r = place(parts, slave) - place(parts, master);
    const double small = 1e-6 * (1.0 + r.norm());
    std::set<int> tied;
    for (const InpEquation* equation : equations) {
      const int to = equation->terms[0].dof;
      const double scale = -equation->terms[0].coefficient;
      std::array<double, 6> factor{};
      for (std::size_t i = 1; i < equation->terms.size(); ++i) {
        const InpEquation::Term& term = equation->terms[i];
        if (term.node != master_id || scale == 0.0) no_rigid_link(parts, *equation);
        factor[static_cast<std::size_t>(term.dof)] += term.coefficient / scale;
      }
      for (int from = 0; from < 6; ++from) {
        if (std::abs(factor[static_cast<std::size_t>(from)] - rigid_factor(r, to, from)) > small)
          no_rigid_link(parts, *equation);
      }
      tied.insert(to);
    }
    // A slave where only trusses or solids meet has no rotation of its own to tie.
    if (tied.size() != (turning.contains(slave_id) ? 6U : std::max<std::size_t>(3, tied.size())) || !tied.contains(0) ||
        !tied.contains(1) || !tied.contains(2)) {
      no_rigid_link(parts, first);
    }
    add_link(parts, master, slave);
  }
}

void attach_inp_rigid_body(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"REF NODE", "NSET", "TIE NSET"});
  const InpLine reference{card.line, {parts.file.required(card, "REF NODE")}};
  const std::vector<long> masters = parts.nodes_of(card, reference, 0);
  if (masters.size() != 1) parts.file.fail(card, card.line, "REF NODE names more than one node", "give one");
  const std::string slaves = card.has("TIE NSET") ? card.get("TIE NSET") : parts.file.required(card, "NSET");
  const int master = parts.node(card, card.line, masters.front());
  for (const long id : parts.set(parts.node_sets, card, card.line, slaves).members) {
    if (const int slave = parts.node(card, card.line, id); slave != master) add_link(parts, master, slave);
  }
}

void attach_inp_mpc(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {});
  for (const InpLine& line : card.data) {
    const std::string type = line.fields.empty() ? "" : upper_case(line.fields[0]);
    if (type != "BEAM")
      parts.file.fail(card, line.line, fmt::format("unsupported MPC type '{}'", type), "BEAM (a rigid link) is supported");
    const std::vector<long> slaves = parts.nodes_of(card, line, 1), masters = parts.nodes_of(card, line, 2);
    if (masters.size() != 1) parts.file.fail(card, line.line, "names more than one master", "BEAM, slave, master");
    const int master = parts.node(card, line.line, masters.front());
    for (const long id : slaves) add_link(parts, master, parts.node(card, line.line, id));
  }
  parts.notes.push_back("*MPC of type BEAM is read as Abaqus means it: a rigid link");
}

}  // namespace twindeck::model_io
