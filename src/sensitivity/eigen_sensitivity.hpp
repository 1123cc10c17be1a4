#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "linalg/symmetric_product.hpp"

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

/// Derivatives of mass-normalised shapes, the solution of Nelson's equations
///   (K - lambda_i M) dphi_i = -(dK - lambda_i dM - dlambda_i M) phi_i,   phi_i' M dphi_i = -1/2 phi_i' dM phi_i,
/// with one factorisation for all modes and all parameters instead of one for each mode. The part in the span of the given
/// modes has a closed form, which is safe for close modes. The rest comes from conjugate gradients on K - lambda_i M, which is
/// positive definite outside that span; its error is 1e-7 in the energy norm. The preconditioner is K⁻¹, and the exact inverse
/// in the span of some twenty approximate modes above the given ones. These modes are computed once; they speed up the
/// iteration and do not change the result.
/// Inside a cluster of equal eigenvalues the shapes are free to rotate. Of that part only what the normalisation fixes is
/// returned: the derivative of the subspace. References: Nelson (1976), AIAA Journal 14, 1201-1205; Fox and Kapoor (1968), AIAA
/// Journal 6, 2426-2429; Saad, Yeung, Erhel and Guyomarc'h (2000), SIAM J. Sci. Comput. 21, 1909-1926 (deflated conjugate
/// gradients).
class ShapeSensitivity {
 public:
  /// @param modes  the lowest modes of `system` at `theta`, none left out. The system must outlive this object.
  ShapeSensitivity(const fe::ParametricSystem& system, Eigen::VectorXd theta, dynamics::EigenModes modes,
                   double cluster_gap = 1e-8);
  /// @param parameter  position in system.parameters
  /// @return (n × n_modes) per unit of parameter
  [[nodiscard]] Eigen::MatrixXd derivative(int parameter) const;

  /// The same for every parameter, in parallel; the result does not depend on the number of threads.
  /// @return (n_parameters) matrices (n × n_modes); with 15 modes of 29,000 degrees of freedom some 3.5 MB each
  [[nodiscard]] std::vector<Eigen::MatrixXd> derivatives() const;

 private:
  void find_further_modes(const linalg::SparseMatrix& shifted_stiffness);
  [[nodiscard]] Eigen::MatrixXd solve_outside_modes(Eigen::MatrixXd residual) const;

  const fe::ParametricSystem& system_;
  Eigen::VectorXd theta_;
  dynamics::EigenModes modes_;
  double cluster_gap_, shift_ = 0.0;
  linalg::Cholesky factor_;  // of A = K - shift M
  std::unique_ptr<linalg::SymmetricProduct> mass_;
  Eigen::MatrixXd mass_shapes_;                  // M Phi
  Eigen::MatrixXd further_, stiffness_further_;  // G and A G (n × g), G' M G = I, G' M Phi = 0
  Eigen::VectorXd further_value_;                // diagonal of G' A G
};

/// Derivatives of the mass-normalised shapes at `channels`, d(c' phi_i)/d theta_p. They equal c' times the derivatives of
/// ShapeSensitivity, at a tenth of the cost if there are few sensors. The adjoint vectors y solve (K - lambda_i M) y = c
/// outside the modes. Then c' dphi = y' f for the force f = -(dK - lambda_i dM) phi_i of any parameter, so the cost hardly
/// depends on the number of parameters. Since c is the same for all modes, one block Krylov space of K⁻¹ M serves all of them:
/// (K - lambda M)⁻¹ c = (1 - lambda K⁻¹ M)⁻¹ K⁻¹ c lies in this space for every lambda. The error of the adjoint vectors is
/// 1e-7 in the M norm.
/// @param modes     the lowest modes of `system` at `theta`, none left out
/// @param channels  (n × n_channels), a unit vector where a channel measures one degree of freedom
/// @return (n_parameters) matrices (n_channels × n_modes) per unit of parameter
/// References: Nelson (1976), AIAA Journal 14, 1201-1205; Murthy and Haftka (1988), Int. J. Num. Meth. Eng. 26, 293-311
/// (adjoint form); Frommer and Glässner (1998), SIAM J. Sci. Comput. 19, 15-26 (one Krylov space for many shifts).
[[nodiscard]] std::vector<Eigen::MatrixXd> channel_shape_derivatives(const fe::ParametricSystem& system,
                                                                     const Eigen::VectorXd& theta,
                                                                     const dynamics::EigenModes& modes,
                                                                     const Eigen::Ref<const Eigen::MatrixXd>& channels,
                                                                     double cluster_gap = 1e-8);

/// ShapeSensitivity's derivative for one parameter (Nelson 1976).
/// @param parameter  position in system.parameters
/// @return (n × n_modes) per unit of parameter
[[nodiscard]] Eigen::MatrixXd shape_derivative(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                               const dynamics::EigenModes& modes, int parameter);

}  // namespace twindeck::sensitivity
