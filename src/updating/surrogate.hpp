#pragma once

#include <Eigen/Core>
#include <memory>

#include "updating/reduced_system.hpp"
#include "updating/residuals.hpp"

namespace twindeck::updating {

/// Data of the reduced model that all searches share: projections of the start model.
struct Surrogate {
  std::shared_ptr<const Eigen::MatrixXd> basis;  ///< Q (n × r); null: there is none
  Eigen::MatrixXd mass_reference, mass;          ///< Q' M phi (r × n_reference), Q' M Q (r × r)
  Eigen::MatrixXd channels;                      ///< Q' C (r × n_channels); empty where no shape is weighed
  std::shared_ptr<const ReducedSystem> initial;
};

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
  CorrectedResiduals(const ReducedSystem& reduced, const ResidualDefinition& definition, const Surrogate& surrogate,
                     const Evaluation& full);
  /// Whether the reduced system has the modes at x_k.
  [[nodiscard]] bool valid() const { return valid_; }
  /// The same corrections of another reduced system, which must outlive the result.
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
