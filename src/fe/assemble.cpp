#include <map>

#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/assembly_pattern.hpp"
#include "fe/assembly_terms.hpp"
#include "fe/large_displacement.hpp"

namespace twindeck::fe {

namespace {

/// Geometric stiffness of members and the string stiffness T/L of stays, one term without parameters.
Term assemble_geometric_stiffness(const Model& model, const PrestressState& state, Scatter& scatter) {
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const Element& e = model.elements[i];
    const auto row = static_cast<Eigen::Index>(i);
    const double force = state.axial_force_N.size() == 0 ? (e.type == ElementType::bar ? e.pull_N : 0.0)
                         : e.type == ElementType::stay   ? state.stay_pull_N[row]
                                                         : state.axial_force_N[row];
    if (force == 0.0 || node_count(e.type) != 2) continue;
    if (e.type == ElementType::beam)
      scatter.add({six_per_node(e), beam_geometric_stiffness(beam_geometry(model, e), force)});
    else
      scatter.add({three_per_node(e), string_stiffness(end_nodes(model, e), force)});
  }
  Term term;
  term.label = "geometric stiffness";
  scatter.take(term);
  return term;
}

}  // namespace

ParametricSystem assemble(const Model& start, const PrestressState& state) {
  validate(start);
  const Model model = deformed_model(start, state);
  const auto n_elements = static_cast<Eigen::Index>(model.elements.size());
  const bool prestressed = state.stay_pull_N.size() > 0;
  TWINDECK_ASSERT(!prestressed || (state.stay_pull_N.size() == n_elements && state.axial_force_N.size() == n_elements));

  DofMap map = make_dof_map(model);
  ParametricSystem system;
  system.parameters = model.parameters;
  system.pattern = make_pattern(model, map);

  Scatter scatter(system.pattern, map);
  system.stiffness_terms = assemble_terms(model, plan_stiffness(model), scatter);
  for (Term& stay : assemble_terms(model, plan_stays(model, state.stay_pull_N), scatter))
    system.stiffness_terms.push_back(std::move(stay));
  if (model.prestress.geometric_stiffness) {
    Term geometric = assemble_geometric_stiffness(model, state, scatter);
    if (!geometric.position.empty()) system.stiffness_terms.push_back(std::move(geometric));
  }
  system.mass_terms = assemble_terms(model, plan_mass(model), scatter);

  system.dofs = std::move(map.dofs);
  if (!state.rotation.empty()) {  // places are named as in nodes.csv
    std::map<std::string, Eigen::Vector3d> place;
    for (const Node& node : start.nodes) place.emplace(std::to_string(node.id), node.x_m);
    for (DofLabel& dof : system.dofs) dof.x_m = place.at(dof.node);
  }
  system.expansion = std::move(map.expansion);
  return system;
}

}  // namespace twindeck::fe
