#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "fe/parametric_system.hpp"

namespace twindeck::updating {

/// Galerkin projection of a parametric system on a fixed basis Q: Q' K(theta) Q = sum a_g(theta) Q' K_g Q, M likewise. Its only
/// error is what the basis cannot represent. Its matrices are dense and have the size of the basis.
class ReducedSystem {
 public:
  /// @param basis (n × r); shared by projections of the same structure under several prestresses
  /// @param like  a projection on the same basis; terms that are equal in both systems are reused. May be null
  ReducedSystem(std::shared_ptr<const fe::ParametricSystem> system, std::shared_ptr<const Eigen::MatrixXd> basis,
                const ReducedSystem* like);

  /// (r × r)
  [[nodiscard]] Eigen::MatrixXd stiffness(const Eigen::VectorXd& theta) const;
  [[nodiscard]] Eigen::MatrixXd mass(const Eigen::VectorXd& theta) const;
  /// The lowest modes, ascending, mass-normalised; empty if the mass is not positive definite.
  /// @return (count), (r × count)
  [[nodiscard]] std::pair<Eigen::VectorXd, Eigen::MatrixXd> modes(const Eigen::VectorXd& theta, Eigen::Index count) const;
  /// d lambda_i / d theta_p = z_i' (dK - lambda_i dM) z_i for mass-normalised z (r × m). (m × n_parameters)
  [[nodiscard]] Eigen::MatrixXd eigenvalue_derivatives(const Eigen::VectorXd& theta, const std::vector<int>& parameters,
                                                       const Eigen::VectorXd& lambda, const Eigen::MatrixXd& z) const;
  /// Derivatives of the first `count` mass-normalised shapes with respect to one parameter, from all reduced modes:
  ///   dz_i = sum over j of z_j z_j' (dK - lambda_i dM) z_i / (lambda_i - lambda_j), for j = i and equal lambda -1/2 z_j' dM
  ///   z_i.
  /// @param lambda, z  all modes (r), (r × r)
  /// @return (r × count) per unit of parameter
  /// Reference: Fox and Kapoor (1968), AIAA Journal 6, 2426-2429.
  [[nodiscard]] Eigen::MatrixXd shape_derivatives(const Eigen::VectorXd& theta, int parameter, const Eigen::VectorXd& lambda,
                                                  const Eigen::MatrixXd& z, Eigen::Index count) const;

 private:
  std::shared_ptr<const fe::ParametricSystem> system_;
  std::shared_ptr<const Eigen::MatrixXd> basis_;
  std::vector<std::shared_ptr<const Eigen::MatrixXd>> stiffness_, mass_;  // one a term
};

/// A basis that spans the given vectors up to a relative error, M-orthonormal (proper orthogonal decomposition).
/// @param vectors (n × m)  @param mass_lower  lower triangle of M
/// @param loss  directions whose size relative to the largest is below this are dropped
/// Reference: Sirovich (1987), Quarterly of Applied Mathematics 45, 561-571 (method of snapshots).
[[nodiscard]] Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& vectors, const linalg::SparseMatrix& mass_lower,
                                                double loss);

}  // namespace twindeck::updating
