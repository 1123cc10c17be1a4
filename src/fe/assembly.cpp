#include "fe/assembly.hpp"

#include "fe/assembly_pattern.hpp"
#include "fe/assembly_terms.hpp"
#include "fe/static_stage.hpp"
#include "fe/structure_parts.hpp"

namespace twindeck::fe {

Term geometric_stiffness(const Model& model, const PrestressState& state, const linalg::SparseMatrix& pattern,
                         const DofMap& map) {
  Scatter scatter(pattern, map);
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const Element& e = model.elements[i];
    const auto row = static_cast<Eigen::Index>(i);
    if (e.type == ElementType::shell || e.type == ElementType::solid) {
      if (!model.prestress.shells_and_solids || model.prestress.rule == PullRule::none || state.displacement.size() == 0)
        continue;
      scatter.add({e.type == ElementType::solid ? three_per_node(e) : six_per_node(e),
                   continuum_geometric_stiffness(model, state, static_cast<int>(i))});
      continue;
    }
    const double force = state.axial_force_N.size() == 0 ? (e.type == ElementType::bar ? e.pull_N : 0.0)
                         : e.type == ElementType::stay   ? state.stay_pull_N[row]
                                                         : state.axial_force_N[row];
    if (force == 0.0) continue;
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

}  // namespace twindeck::fe
