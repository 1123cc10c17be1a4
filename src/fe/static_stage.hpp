#pragma once

#include <Eigen/Core>

#include "fe/model.hpp"
#include "fe/prestress.hpp"

/// The static stage about which modes are computed, apart from cable forces: loads of Prestress::loads, movements of supports,
/// strains without forces (Element::free_strain).
namespace twindeck::fe {

/// Tension of a bar in the geometry of nodes.csv: its pull and what a free strain that is held back adds, pull - E A ε [N].
[[nodiscard]] double initial_tension(const Model& model, const Element& bar);

/// Displacements of a free strain ε, u = ε (x - x_1) at each node, rotations 0: they strain the element by ε everywhere.
/// @return [m, rad] over the degrees of freedom of the element's stiffness: six a node, three for solids and bars
[[nodiscard]] Eigen::VectorXd free_displacement(const Model& model, const Element& element);

/// Movements of supports over all degrees of freedom (6 n_nodes), with what rigid links and constraints carry along.
/// @throws InputError  for a movement of a displacement that no support holds
[[nodiscard]] Eigen::VectorXd support_movement(const Model& model);

/// What acts beside dead load and cable forces (6 n_nodes) [N, N m]: forces and moments, and for the parts in K
/// Σ K_e (u_free - u_support).
/// @param movement  support_movement of the model
[[nodiscard]] Eigen::VectorXd stage_load(const Model& model, const Eigen::VectorXd& movement);

/// Geometric stiffness of a shell or a solid whose stresses are those of the state.
/// @param i  position of the element
[[nodiscard]] Eigen::MatrixXd continuum_geometric_stiffness(const Model& model, const PrestressState& state, int i);

/// Weight of everything that has mass, f = g M e (e: direction of gravity) over all nodes before supports and links are
/// eliminated: consistent for beams (end moments w L²/12) and shells, half at each end for stays.
/// @return [N, N m] (6 n_nodes)
[[nodiscard]] Eigen::VectorXd dead_load(const Model& model);

}  // namespace twindeck::fe
