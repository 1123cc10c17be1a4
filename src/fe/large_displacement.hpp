#pragma once

#include "fe/assembly.hpp"

namespace twindeck::fe {

/// Nodes that have moved and turned by any amount.
struct Configuration {
  Eigen::VectorXd displacement;           ///< (6 n_nodes) translations [m] and rotation vectors
  std::vector<Eigen::Matrix3d> rotation;  ///< (n_nodes)
  Eigen::VectorXd axial_force_N;          ///< (n_elements) beams and bars; tension positive
  Status status;                          ///< not converged: at which part of the load, how far from balance, at which node
  int iterations = 0;                     ///< factorisations in all
};

/// Equilibrium in the deformed geometry under `load` and stay pulls, f_int(x) = λ (f_ext + pulls along the stays as they now
/// run), by Newton's method with the co-rotational tangent (corotational.hpp), λ in `load_steps` equal steps, and a line search
/// on the work of the unbalanced forces along each correction. A step that fails is halved, six times at most. Beams, shells
/// and solids are co-rotational, bars exact; rigid links and offsets turn with their nodes; springs and matrix elements act
/// linearly on the displacements. Loads keep their direction. Pulls of stays and initial tensions of bars grow with λ.
/// Converged when the unbalanced forces are below 1e-8 of the loads (1e-5 once a correction no longer moves anything to eleven
/// digits: the rest is rounding in stiff members) and the tangent is positive definite: the state is stable.
/// @param load         (6 n_nodes) [N, N m]
/// @param stay_pull_N  (n_elements), 0 for what is no stay
/// @param start        a configuration to start from (λ = 1 at once); nullptr: from the undeformed state in steps
[[nodiscard]] Configuration find_equilibrium(const Model& model, const Eigen::VectorXd& load,
                                             const Eigen::VectorXd& stay_pull_N, int load_steps,
                                             const Configuration* start = nullptr);

/// The model as it stands after `state`: nodes, offsets and orientations of beams moved and turned. Its linear stiffness with
/// the geometric stiffness of the forces in it is the tangent about that state.
[[nodiscard]] Model deformed_model(const Model& model, const PrestressState& state);

}  // namespace twindeck::fe
