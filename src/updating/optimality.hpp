#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::updating {

/// Box lower <= x <= upper, in normalised parameters (n).
struct Box {
  Eigen::VectorXd lower, upper;
};

/// Where each component stands: -1 on its lower bound, +1 on its upper bound, 0 inside.
/// @param tolerance  distance that still counts as on the bound, as a fraction of upper - lower
[[nodiscard]] std::vector<int> on_bound(const Eigen::VectorXd& x, const Box& box, double tolerance);

/// Components that the bounds hold: on a bound with the descent direction -g pointing out of the box (the Lagrange multiplier
/// has its right sign). These stay where they are; the others are free.
[[nodiscard]] std::vector<bool> held(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Box& box, double tolerance);

/// Gradient without the components that the bounds hold: zero exactly at a first-order (KKT) point of min F on the box.
/// @param gradient (n) of F at x
/// Reference: Nocedal and Wright (2006), Numerical Optimization, section 16.7.
[[nodiscard]] Eigen::VectorXd projected_gradient(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Box& box,
                                                 double tolerance);

/// What a projected gradient is measured against: the gradient where the search started, but at least what residuals of 1e-4
/// (relative frequency, far below any measurement) would cause. The floor lets a search that starts on its optimum end.
/// @param gradient J'r, @param jacobian (n_residuals × n), both at the starting point
[[nodiscard]] double gradient_reference(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& jacobian);

}  // namespace twindeck::updating
