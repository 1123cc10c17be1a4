#pragma once

#include <Eigen/Core>

#include "dynamics/eigenmodes.hpp"

namespace twindeck::dynamics {

/// d lambda_i / d theta_p = phi_i' (dK - lambda_i dM) phi_i, exact for distinct eigenvalues (Fox and Kapoor 1968), and
/// df = d lambda / (8 pi² f); 0 for rigid-body modes. A cluster of eigenvalues closer than `cluster_gap` (relative) is
/// differentiated as a subspace: the derivatives are the eigenvalues of the projected matrix, each given to the mode that its
/// rotated shape resembles most (Ojalvo 1988; Dailey 1989). Without factorisation: one pass over the entries of the terms.
/// @param theta [parameters' units]
/// @return [Hz per unit of parameter] (n_modes × n_parameters)
[[nodiscard]] Eigen::MatrixXd frequency_jacobian(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                                 const EigenModes& modes, double cluster_gap = 1e-8);

/// Derivatives of mass-normalised shapes, the solution of Nelson's equations
///   (K - lambda_i M) dphi_i = -(dK - lambda_i dM - dlambda_i M) phi_i,   phi_i' M dphi_i = -1/2 phi_i' dM phi_i,
/// with one factorisation for all modes and all parameters instead of one a mode: the part in the span of the given modes in
/// closed form, so that close modes do no harm; the rest by conjugate gradients on K - lambda_i M, which is positive definite
/// outside that span, preconditioned with K. Inside a cluster of equal eigenvalues the shapes turn freely, and of that part
/// only what the normalisation fixes is returned: the derivative of the subspace. References: Nelson (1976), AIAA Journal 14,
/// 1201-1205; Fox and Kapoor (1968), AIAA Journal 6, 2426-2429.
class ShapeSensitivity {
 public:
  /// @param modes  the lowest modes of `system` at `theta`, none left out. The system must outlive this object.
  ShapeSensitivity(const fe::ParametricSystem& system, Eigen::VectorXd theta, EigenModes modes, double cluster_gap = 1e-8);
  /// @param parameter  position in system.parameters
  /// @return (n × n_modes) per unit of parameter
  [[nodiscard]] Eigen::MatrixXd derivative(int parameter) const;

 private:
  const fe::ParametricSystem& system_;
  Eigen::VectorXd theta_;
  EigenModes modes_;
  double cluster_gap_;
  linalg::SparseMatrix stiffness_, mass_;
  linalg::Cholesky factor_;
  Eigen::MatrixXd mass_shapes_;  // M Phi
};

/// The same for one parameter (Nelson 1976).
/// @param parameter  position in system.parameters
/// @return (n × n_modes) per unit of parameter
[[nodiscard]] Eigen::MatrixXd shape_derivative(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                               const EigenModes& modes, int parameter);

}  // namespace twindeck::dynamics
