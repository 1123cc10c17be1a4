#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "updating/reduced_system.hpp"
#include "updating/residuals.hpp"

namespace twindeck::updating {

/// A basis for the modes of a system over the whole box: the modes at the given points, and for the targets' modes at the first
/// point the static answer K^-1 (dK - lambda dM) phi to each parameter.
/// @param points (n_active × n_points) normalised parameters; solved side by side
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
  CorrectedResiduals(const ReducedSystem& reduced, const ResidualDefinition& definition,
                     const Eigen::MatrixXd& reduced_mass_reference, const Eigen::MatrixXd& reduced_mass,
                     const Evaluation& full);
  /// Whether the reduced system has the modes at x_k.
  [[nodiscard]] bool valid() const { return valid_; }
  /// A ResidualFunction.
  bool operator()(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) const;

 private:
  bool reduced_at(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) const;

  const ReducedSystem& reduced_;
  const ResidualDefinition& definition_;
  const Eigen::MatrixXd &mass_reference_, &mass_;  // Q' M phi (r × n_reference) and Q' M Q of the start model
  Eigen::VectorXd centre_, shift_;
  Eigen::MatrixXd turn_;
  bool valid_ = false;
};

}  // namespace twindeck::updating
