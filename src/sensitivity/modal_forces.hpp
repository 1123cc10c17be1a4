#pragma once

#include <Eigen/Core>

#include "dynamics/eigenmodes.hpp"
#include "linalg/cholesky.hpp"

namespace twindeck::sensitivity {

/// Effect of a parameter on the modes: right-hand sides of Nelson's equations, and their solution in the span of the modes.
struct ModalForces {
  Eigen::MatrixXd force;  ///< (n × n_modes)  -(dK - lambda_i dM) phi_i; the term of dlambda_i lies along M phi_i
  Eigen::MatrixXd along;  ///< (n_modes × n_modes) part of dphi_i along phi_j: phi_j' force_i / (lambda_j - lambda_i); inside a
                          ///< cluster and for j = i what the normalisation fixes, -1/2 phi_j' dM phi_i
};
/// @param cluster_gap  relative difference of eigenvalues that are taken as equal
[[nodiscard]] ModalForces modal_forces(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                       const dynamics::EigenModes& modes, int parameter, double cluster_gap);

/// Factorises K(theta) - shift M, the shift 0 or, for a structure that is free as a rigid body, a small negative number.
/// @param stiffness  in: K; out: K - shift M @return the shift [rad²/s²]
[[nodiscard]] double factorize_shifted(linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass,
                                       linalg::Cholesky& factor);

}  // namespace twindeck::sensitivity
