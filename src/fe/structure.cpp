#include "fe/structure.hpp"

#include <utility>

#include "core/error.hpp"
#include "fe/assembly_pattern.hpp"
#include "fe/assembly_plans.hpp"
#include "fe/assembly_terms.hpp"
#include "fe/large_displacement.hpp"
#include "fe/structure_parts.hpp"
#include "fe/term_sum.hpp"

namespace twindeck::fe {

namespace {

std::shared_ptr<const Structure::Parts> numbered_and_assembled(Model model) {
  auto parts = std::make_shared<Structure::Parts>();
  parts->map = make_dof_map(model);
  parts->pattern = make_pattern(model, parts->map);
  parts->stiffness = assemble_terms(model, plan_stiffness(model), parts->pattern, parts->map);
  parts->mass = assemble_terms(model, plan_mass(model), parts->pattern, parts->map);
  parts->model = std::move(model);
  return parts;
}

/// The system of `parts`' geometry with the forces of a state.
ParametricSystem stiffened(const Structure::Parts& parts, const PrestressState& state) {
  const Model& model = parts.model;
  ParametricSystem system;
  system.parameters = model.parameters;
  system.pattern = parts.pattern;
  system.stiffness_terms = parts.stiffness;
  for (Term& stay : assemble_terms(model, plan_stays(model, state.stay_pull_N), parts.pattern, parts.map))
    system.stiffness_terms.push_back(std::move(stay));
  if (model.prestress.geometric_stiffness) {
    Term geometric = geometric_stiffness(model, state, parts.pattern, parts.map);
    if (!geometric.position.empty()) system.stiffness_terms.push_back(std::move(geometric));
  }
  system.mass_terms = parts.mass;
  system.dofs = parts.map.dofs;
  system.expansion = parts.map.expansion;
  return system;
}

}  // namespace

Structure::Structure(Model model) {
  validate(model);
  parts_ = numbered_and_assembled(std::move(model));
}

const Model& Structure::model() const { return parts_->model; }

PrestressState Structure::prestress(const Eigen::VectorXd& theta) const {
  if (model().prestress.rule == PullRule::none) return unstressed(model());
  std::vector<Term> terms = parts_->stiffness;
  if (model().prestress.geometric_stiffness) {
    Term tension = initial_tension_stiffness(model(), parts_->pattern, parts_->map);
    if (!tension.position.empty()) terms.push_back(std::move(tension));
  }
  return prestress_of(model(), parts_->map, combine(parts_->pattern, terms, theta), theta);
}

ParametricSystem Structure::system(const PrestressState& state) const {
  const auto n_elements = static_cast<Eigen::Index>(model().elements.size());
  const bool prestressed = state.stay_pull_N.size() > 0;
  TWINDECK_ASSERT(!prestressed || (state.stay_pull_N.size() == n_elements && state.axial_force_N.size() == n_elements));
  if (state.rotation.empty()) return stiffened(*parts_, state);
  // After large displacements everything lies elsewhere; places are named as in nodes.csv.
  ParametricSystem system = stiffened(*numbered_and_assembled(deformed_model(model(), state)), state);
  for (std::size_t i = 0; i < system.dofs.size(); ++i) system.dofs[i].x_m = parts_->map.dofs[i].x_m;
  return system;
}

PrestressState find_prestress(const Model& model, const Eigen::VectorXd& theta) { return Structure(model).prestress(theta); }

ParametricSystem assemble(const Model& model, const PrestressState& state) { return Structure(model).system(state); }

}  // namespace twindeck::fe
