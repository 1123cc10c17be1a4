#include "fe/static_stage.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/assembly_plans.hpp"

namespace twindeck::fe {

namespace {

/// Adds Σ K_e u over the parts of K; `displacement` gives u of a part, or an empty vector for none.
template <typename Displacement>
void add_forces(const Model& model, const Displacement& displacement, Eigen::VectorXd& force) {
  for (const TermPlan& plan : plan_stiffness(model))
    for (const int part : plan.parts) {
      const Eigen::VectorXd u = displacement(plan, part);
      if (u.size() == 0) continue;
      const ElementMatrix k = plan.matrix(model, part);
      const Eigen::VectorXd f = k.matrix * u;
      for (Eigen::Index i = 0; i < f.size(); ++i) force[k.dofs[slot(static_cast<int>(i))]] += f[i];
    }
}

bool is_held(const Model& model, int node, int direction) {
  for (const Support& support : model.supports)
    if (support.node == node && support.fixed[slot(direction)]) return true;
  return false;
}

/// Moves the slaves of rigid links with their masters and the dependent displacements with their terms, until all have moved:
/// a chain is no longer than the number of links.
void carry_along(const Model& model, Eigen::VectorXd& u) {
  for (std::size_t round = 0; round <= model.links.size() + model.constraints.size(); ++round) {
    const Eigen::VectorXd before = u;
    for (const RigidLink& link : model.links) {
      const Eigen::Vector3d arm = model.nodes[slot(link.slave)].x_m - model.nodes[slot(link.master)].x_m;
      const Eigen::Vector3d turn = u.segment<3>(6 * link.master + 3);
      u.segment<3>(6 * link.slave) = u.segment<3>(6 * link.master) + turn.cross(arm);
      u.segment<3>(6 * link.slave + 3) = turn;
    }
    for (const Constraint& c : model.constraints) {
      double sum = 0.0;
      for (const Constraint::Term& term : c.terms) sum += term.factor * u[6 * term.node + term.direction];
      u[6 * c.node + c.direction] = sum;
    }
    if (u == before) return;
  }
}

/// Displacements that strain a shell or solid, in the geometry of `model`.
Eigen::VectorXd straining_displacement(const Model& model, const PrestressState& state, int i) {
  if (!state.strained.empty()) return state.strained[slot(i)];
  const Element& e = element_at(model, i);
  const std::vector<int> dofs = e.type == ElementType::solid ? three_per_node(e) : six_per_node(e);
  return state.displacement(dofs) - free_displacement(model, e);
}

/// Adds M_e e, where e moves every node by the acceleration of gravity.
void add_weight(const ElementMatrix& mass, const Eigen::Vector3d& gravity_m_s2, Eigen::VectorXd& load) {
  for (std::size_t j = 0; j < mass.dofs.size(); ++j) {
    const int direction = mass.dofs[j] % 6;
    if (direction > 2 || gravity_m_s2[direction] == 0.0) continue;
    for (std::size_t i = 0; i < mass.dofs.size(); ++i)
      load[mass.dofs[i]] += gravity_m_s2[direction] * mass.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
}

}  // namespace

double initial_tension(const Model& model, const Element& bar) {
  const double held_back = bar.free_strain == 0.0
                               ? 0.0
                               : material_of(model, bar).youngs_modulus_Pa * section_of(model, bar).area_m2 * bar.free_strain;
  return bar.pull_N - held_back;
}

Eigen::VectorXd free_displacement(const Model& model, const Element& element) {
  const Eigen::Index per_node = element.type == ElementType::beam || element.type == ElementType::shell ? 6 : 3;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(per_node * std::ssize(element.nodes));
  if (element.free_strain == 0.0) return u;
  const auto place = [&](std::size_t a) -> Eigen::Vector3d {
    const Eigen::Vector3d x = model.nodes[slot(element.nodes[a])].x_m;
    return element.type == ElementType::beam ? Eigen::Vector3d(x + element.offset_m[a]) : x;
  };
  for (std::size_t a = 0; a < element.nodes.size(); ++a)
    u.segment<3>(per_node * static_cast<Eigen::Index>(a)) = element.free_strain * (place(a) - place(0));
  return u;
}

Eigen::VectorXd support_movement(const Model& model) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * std::ssize(model.nodes));
  bool moves = false;
  for (const Prestress::Load& load : model.prestress.loads) {
    if (!load.movement) continue;
    if (!is_held(model, load.node, load.direction))
      throw InputError({model.source, 0, "load case " + model.prestress.load_case},
                       fmt::format("moves node {} in direction {}, which no support holds", model.nodes[slot(load.node)].id,
                                   std::string("xyz").substr(slot(load.direction), 1)),
                       "give the node a support in that direction, or load it by a force");
    u[6 * load.node + load.direction] += load.value;
    moves = true;
  }
  if (moves) carry_along(model, u);
  return u;
}

Eigen::VectorXd stage_load(const Model& model, const Eigen::VectorXd& movement) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * std::ssize(model.nodes));
  bool strains = false;
  for (const Element& e : model.elements) strains = strains || (e.free_strain != 0.0 && e.type != ElementType::bar);
  if (strains)
    add_forces(
        model,
        [&](const TermPlan& plan, int part) -> Eigen::VectorXd {
          // A free strain of a bar is a part of its initial tension.
          if (!plan.of_elements || element_at(model, part).free_strain == 0.0) return {};
          const Element& e = element_at(model, part);
          return e.type == ElementType::bar ? Eigen::VectorXd() : free_displacement(model, e);
        },
        load);
  if (!movement.isZero(0.0)) {
    Eigen::VectorXd reaction = Eigen::VectorXd::Zero(load.size());
    add_forces(
        model,
        [&](const TermPlan& plan, int part) -> Eigen::VectorXd {
          const Eigen::VectorXd u = movement(plan.matrix(model, part).dofs);
          return u.isZero(0.0) ? Eigen::VectorXd() : u;
        },
        reaction);
    load -= reaction;
  }
  for (const Prestress::Load& l : model.prestress.loads)
    if (!l.movement) load[6 * l.node + l.direction] += l.value;
  return load;
}

Eigen::MatrixXd continuum_geometric_stiffness(const Model& model, const PrestressState& state, int i) {
  const Element& e = element_at(model, i);
  const Eigen::VectorXd u = straining_displacement(model, state, i);
  if (e.type == ElementType::solid) return solid_geometric_stiffness_of(model, e, u);
  if (is_triangle(e)) return triangle_geometric_stiffness(triangle_geometry(model, e), shell_properties(model, e), u);
  return shell_geometric_stiffness(shell_geometry(model, e), shell_properties(model, e), model.formulation.drilling,
                                   model.formulation.drilling_factor, u);
}

Eigen::VectorXd dead_load(const Model& model) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(model.nodes.size()));
  const Eigen::Vector3d gravity_m_s2 = model.gravity_m_s2 * model.gravity_direction;
  if (gravity_m_s2.isZero(0.0)) return load;
  for (const Element& element : model.elements) add_weight(element_mass(model, element), gravity_m_s2, load);
  for (const PointMass& mass : model.masses) add_weight(point_mass(mass), gravity_m_s2, load);
  return load;
}

}  // namespace twindeck::fe
