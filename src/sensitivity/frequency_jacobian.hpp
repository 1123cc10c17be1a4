#pragma once

#include <Eigen/Core>

#include "dynamics/eigenmodes.hpp"

namespace twindeck::sensitivity {

/// d lambda_i / d theta_p = phi_i' (dK - lambda_i dM) phi_i, exact for distinct eigenvalues (Fox and Kapoor 1968), and
/// df = d lambda / (8 pi² f); 0 for rigid-body modes. A cluster of eigenvalues closer than `cluster_gap` (relative) is
/// differentiated as a subspace: the derivatives are the eigenvalues of the projected matrix. Each is assigned to the mode that
/// its rotated shape resembles most (Ojalvo 1988; Dailey 1989). No factorisation is needed, only one pass over the entries of
/// the terms.
/// @param theta [parameters' units]
/// @return [Hz per unit of parameter] (n_modes × n_parameters)
[[nodiscard]] Eigen::MatrixXd frequency_jacobian(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                                 const dynamics::EigenModes& modes, double cluster_gap = 1e-8);

}  // namespace twindeck::sensitivity
