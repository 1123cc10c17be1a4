#pragma once

#include <Eigen/Core>

#include "core/error.hpp"

namespace twindeck::fe {

/// Minimiser of |A x - b|² over x >= lower.
struct BoundedLeastSquares {
  Eigen::VectorXd x;
  Status status;
};

/// Active-set method for a few tens of unknowns. It starts on the bounds, frees the unknown with the steepest descent, solves
/// for the free unknowns and steps back to the first bound that is crossed. It ends when the Karush-Kuhn-Tucker conditions
/// hold.
/// @param a  (m × n), full column rank
/// Reference: Lawson and Hanson (1974), chapter 23.
[[nodiscard]] BoundedLeastSquares solve_bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double lower);

}  // namespace twindeck::fe
