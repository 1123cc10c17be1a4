#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "linalg/types.hpp"

namespace twindeck::sensitivity {

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
  /// @return y, the preconditioner times the residual, and A y
  [[nodiscard]] std::pair<Eigen::MatrixXd, Eigen::MatrixXd> precondition(const Eigen::MatrixXd& residual,
                                                                         const Eigen::VectorXd& eigenvalue) const;
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

}  // namespace twindeck::sensitivity
