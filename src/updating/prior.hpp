#pragma once

#include <Eigen/Core>

#include "updating/optimality.hpp"

namespace twindeck::updating {

/// Knowledge of the parameters before the measurement. Each lies in its range; the mean is its initial value, and the deviation
/// that of a uniform law, the range over the root of 12. An update with this prior is the maximum a posteriori estimate of
///
///   y = g(x) + e,  e ~ N(0, s² 1),  x ~ N(x0, D),  D = diag(deviation²),
///
/// which is least squares with the further rows s (x - x0) / deviation. Weighed rows are in standard deviations, so s = 1.
/// Relative frequencies have no deviation of their own: s, mostly the error of the model, is estimated.
struct Prior {
  Eigen::VectorXd mean, deviation;  ///< (n_active) of normalised parameters; empty: none
  double model_error = 1.0;         ///< s
  Eigen::VectorXd residual;         ///< (n_rows) relative frequencies at `mean`, to estimate s; empty where s is given
  Eigen::MatrixXd jacobian;         ///< (n_rows × n_active) at `mean`, likewise

  [[nodiscard]] bool given() const { return mean.size() > 0; }
  /// Puts the prior's rows behind those of the frequencies. @param jacobian  null, or the rows' own (n_rows × n_active)
  void append(const Eigen::VectorXd& x, Eigen::VectorXd& rows, Eigen::MatrixXd* slope) const;
  /// The prior of an update that leaves a row out, with s from the others.
  [[nodiscard]] Prior without(Eigen::Index row) const;
};

/// @param residual,jacobian  of relative frequencies at the initial values; empty: of rows that are weighed
[[nodiscard]] Prior prior_of_ranges(const Box& box, const Eigen::VectorXd& initial, const Eigen::VectorXd& residual,
                                    const Eigen::MatrixXd& jacobian);

/// The s between 0.1 % and 100 % under which the residual at the initial values is most likely: r ~ N(0, s² 1 + J D J'), with a
/// model that is linear over the ranges (type II maximum likelihood, MacKay 1992).
[[nodiscard]] double estimated_model_error(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                                           const Eigen::VectorXd& deviation);

}  // namespace twindeck::updating
