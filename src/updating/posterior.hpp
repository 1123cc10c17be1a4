#pragma once

#include <Eigen/Core>
#include <vector>

#include "updating/optimality.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {

/// A direction in which the parameters can move with hardly any change of the weighed rows.
struct FlatDirection {
  Eigen::VectorXd step;  ///< (n_active) in the parameters' units, one prior standard deviation long
  double change = 0.0;   ///< [standard deviations] of all rows together, along the step
};

/// Covariance of the parameters at the optimum of weighed rows, linearised there. Before the measurement each parameter is
/// taken as anywhere within its bounds: a standard deviation of the range over sqrt(12). With D these deviations,
///   C = (J'J + D⁻²)⁻¹
/// over the free parameters. A parameter that its bound holds back is a constant there and has no deviation.
/// Reference: Tarantola (2005), Inverse Problem Theory, section 3.2.3.
struct Posterior {
  std::vector<bool> is_held;        ///< (n_active) the descent direction points out of the bounds
  Eigen::VectorXd prior_std;        ///< (n_active) in the parameters' units
  Eigen::VectorXd std;              ///< (n_active) likewise; NaN for a held one
  Eigen::MatrixXd correlation;      ///< (n_active × n_active); NaN for a held one
  double chi_squared = 0.0;         ///< sum of squared residuals
  int degrees = 0;                  ///< of freedom: rows, less free scales and free parameters; at least 0
  std::vector<FlatDirection> flat;  ///< directions whose variance the rows lower by less than half, flattest first

  /// Factor between the differences of model and rows and their stated deviations: sqrt(chi²/degrees), at least 1.
  [[nodiscard]] double misfit() const;
  /// chi² as a standard normal variable [standard deviations].
  /// Reference: Wilson and Hilferty (1931), Proc. National Academy of Sciences 17, 684-688.
  [[nodiscard]] double chi_squared_score() const;
};

/// @param at     residuals and Jacobian at the optimum  @param x  (n_active) normalised parameters there
/// @param box    their bounds  @param scale (n_active) parameter = scale · x
[[nodiscard]] Posterior posterior(const Linearised& at, const Eigen::VectorXd& x, const Box& box, const Eigen::VectorXd& scale);

/// Sets of parameters that the rows cannot distinguish: the change of the rows by one parameter over half its range equals a
/// multiple of the change by another, to within one standard deviation of all rows together. A parameter with a smaller change
/// is in no set.
/// @param shifts  [standard deviations] (n_rows × n_parameters) change of the rows over half the range of each parameter
/// @return positions, each set in ascending order
[[nodiscard]] std::vector<std::vector<int>> indistinct_sets(const Eigen::MatrixXd& shifts);

}  // namespace twindeck::updating
