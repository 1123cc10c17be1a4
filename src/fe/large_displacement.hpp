#pragma once

#include "fe/assembly.hpp"

namespace twindeck::fe {

/// State with large displacements and rotations of nodes.
struct Configuration {
  Eigen::VectorXd displacement;           ///< (6 n_nodes) translations [m] and rotation vectors
  std::vector<Eigen::Matrix3d> rotation;  ///< (n_nodes)
  Eigen::VectorXd axial_force_N;          ///< (n_elements) beams and bars; tension positive
  std::vector<Eigen::VectorXd> strained;  ///< (n_elements) as PrestressState::strained
  Status status;                          ///< not converged: at which part of the load, how far from balance, at which node
  int iterations = 0;                     ///< factorisations in all
};

/// Equilibrium in the deformed geometry under `load` and cable forces, f_int(x) = λ (f_ext + cable forces along the displaced
/// stays). Newton's method with the co-rotational tangent (corotational.hpp), λ in `load_steps` equal steps, and a line search
/// on the work of the unbalanced forces along each correction. A step that fails is halved, at most six times. Beams, shells
/// and solids are co-rotational, bars exact. Rigid links and offsets rotate with their nodes. Springs and matrix elements act
/// linearly on the displacements. Loads keep their direction. Cable forces and initial tensions of bars grow with λ.
/// The state has converged if the tangent is positive definite (a stable state) and the unbalanced forces are below 1e-8 of the
/// loads. If a correction changes no displacement to eleven digits, 1e-5 is enough: the rest is rounding in stiff members.
/// @param load         (6 n_nodes) [N, N m]
/// @param stay_pull_N  (n_elements) cable forces, 0 if the element is not a stay
/// @param start        a configuration to start from (λ = 1 at once); nullptr: from the undeformed state in steps
[[nodiscard]] Configuration find_equilibrium(const Model& model, const Eigen::VectorXd& load,
                                             const Eigen::VectorXd& stay_pull_N, int load_steps,
                                             const Configuration* start = nullptr);

/// The model in the deformed geometry of `state`: nodes, offsets and beam orientations are moved and rotated. Its linear
/// stiffness with the geometric stiffness of its forces is the tangent at that state.
[[nodiscard]] Model deformed_model(const Model& model, const PrestressState& state);

}  // namespace twindeck::fe
