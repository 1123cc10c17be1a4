#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "fe/parametric_system.hpp"
#include "updating/residuals.hpp"

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

/// Data of the reduced model that all searches share: projections of the start model.
struct Surrogate {
  std::shared_ptr<const Eigen::MatrixXd> basis;  ///< Q (n × r); null: there is none
  Eigen::MatrixXd mass_reference, mass;          ///< Q' M phi (r × n_reference), Q' M Q (r × r)
  Eigen::MatrixXd channels;                      ///< Q' C (r × n_channels); empty where no shape is weighed
  std::shared_ptr<const ReducedSystem> initial;
};

/// A basis for the modes of a system over the whole box: the modes at the given points, and static responses K^-1 (dK - lambda
/// dM) phi of the targets' modes to each parameter at the first point.
/// @param points (n_active × n_points) normalised parameters; solved in parallel
/// @return null if the modes of the first point were not found
[[nodiscard]] std::shared_ptr<const Eigen::MatrixXd> modal_basis(const std::shared_ptr<const fe::ParametricSystem>& system,
                                                                 const ResidualDefinition& definition,
                                                                 const Eigen::MatrixXd& points);

/// Residuals of a reduced system, corrected so that value and Jacobian at one point equal those of the full system:
///   r(x) = r_red(x) + [r(x_k) - r_red(x_k)] + [J(x_k) - J_red(x_k)] (x - x_k).
/// If a search on it converges to x_k, x_k is also an optimum of the full system.
/// Reference: Alexandrov and Lewis (2001), Optimization and Engineering 2, 413-430 (first-order model management).
class CorrectedResiduals {
 public:
  /// @param full  evaluation of the full system at x_k, valid and with its Jacobian
  CorrectedResiduals(const ReducedSystem& reduced, const ResidualDefinition& definition, const Surrogate& surrogate,
                     const Evaluation& full);
  /// Whether the reduced system has the modes at x_k.
  [[nodiscard]] bool valid() const { return valid_; }
  /// Applies the same corrections to another reduced system, which must outlive the result.
  [[nodiscard]] CorrectedResiduals of(const ReducedSystem& reduced) const {
    CorrectedResiduals other = *this;
    other.reduced_ = &reduced;
    return other;
  }
  /// A ResidualFunction.
  bool operator()(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) const;

 private:
  struct Modes;
  bool weighted_at(const Modes& modes, const Eigen::VectorXd& theta, Eigen::VectorXd& residual,
                   Eigen::MatrixXd* jacobian) const;
  bool reduced_at(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) const;
  bool rows_at(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) const;  ///< without the prior

  const ReducedSystem* reduced_;
  const ResidualDefinition& definition_;
  const Surrogate& surrogate_;
  Eigen::VectorXd centre_, shift_;
  Eigen::MatrixXd turn_;
  bool valid_ = false;
};

}  // namespace twindeck::updating
