#pragma once

#include <Eigen/Core>

#include "dynamics/eigenmodes.hpp"

namespace twindeck::dynamics {

/// d lambda_i / d theta_p = phi_i' (dK - lambda_i dM) phi_i, exact for distinct eigenvalues (Fox and Kapoor 1968). A cluster of
/// eigenvalues closer than `cluster_gap` (relative) is differentiated as a subspace: the derivatives are the eigenvalues of the
/// projected matrix, in the order of the rotated shapes (Ojalvo 1988; Dailey 1989).
/// @param theta [parameters' units]
/// @return [Hz per unit of parameter] (n_modes × n_parameters)
[[nodiscard]] Eigen::MatrixXd frequency_jacobian(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                                 const EigenModes& modes, double cluster_gap = 1e-8);

/// Derivative of mass-normalised shapes with respect to one parameter (Nelson 1976).
/// @param parameter  position in system.parameters
/// @return (n × n_modes) per unit of parameter
[[nodiscard]] Eigen::MatrixXd shape_derivative(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                               const EigenModes& modes, int parameter);

}  // namespace twindeck::dynamics
