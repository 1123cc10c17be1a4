#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/error.hpp"
#include "fe/model.hpp"

namespace twindeck::fe {

/// Static state under dead load, cable forces and the loads of the stage, which gives the geometric stiffness.
struct PrestressState {
  Eigen::VectorXd stay_pull_N;            ///< (n_elements) cable forces; 0 if the element is not a stay
  Eigen::VectorXd axial_force_N;          ///< (n_elements), beams and bars; tension positive
  Eigen::VectorXd displacement;           ///< (6 n_nodes) under dead load and cable forces [m, rad]
  std::vector<Eigen::Matrix3d> rotation;  ///< (n_nodes) of nodes under large displacements; empty for linear statics
  /// (n_elements) displacements that strain a shell or solid, turned with it; filled under large displacements alone
  std::vector<Eigen::VectorXd> strained;
  Status status;
};

/// Cable forces and the axial forces in equilibrium with them (prestress rule of the model). The default is linear statics. If
/// the model asks for large displacements, equilibrium holds in the deformed geometry, with cable forces along the displaced
/// stays; shape finding then corrects the cable forces until the displacements of that state are smallest. If there is no
/// equilibrium, the status says at which part of the load and why.
/// `theta` are the parameter values (a density changes the dead load). The stiffness of stays is not used in this state.
/// @throws InputError for a mechanism, naming a node and its free degrees of freedom
[[nodiscard]] PrestressState find_prestress(const Model& model, const Eigen::VectorXd& theta);

/// Minimiser of |A x - b|² over x >= lower.
struct BoundedLeastSquares {
  Eigen::VectorXd x;
  Status status;
};

/// Active-set method for a few tens of unknowns. It starts on the bounds, frees the unknown with the steepest descent, solves
/// for the free unknowns and steps back to the first bound that is crossed. It ends when the Karush-Kuhn-Tucker conditions
/// hold.
/// @param a  (m × n), full column rank
/// Reference: Lawson and Hanson (1974), chapter 23.
[[nodiscard]] BoundedLeastSquares solve_bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double lower);

}  // namespace twindeck::fe
