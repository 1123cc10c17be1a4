#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::updating {

/// Box lower <= x <= upper, in normalised parameters (n).
struct Box {
  Eigen::VectorXd lower, upper;
};

/// Position of each component: -1 on its lower bound, +1 on its upper bound, 0 inside.
/// @param tolerance  distance that still counts as on the bound, as a fraction of upper - lower
[[nodiscard]] std::vector<int> on_bound(const Eigen::VectorXd& x, const Box& box, double tolerance);

/// Active components: on a bound with the descent direction -g pointing out of the box (the Lagrange multiplier
/// has the right sign). These stay on the bound; the others are free.
[[nodiscard]] std::vector<bool> held(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Box& box,
                                     double tolerance);

/// Gradient without the active components. It is zero exactly at a first-order (KKT) point of min F on the box.
/// @param gradient (n) of F at x
/// Reference: Nocedal and Wright (2006), Numerical Optimization, section 16.7.
[[nodiscard]] Eigen::VectorXd projected_gradient(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Box& box,
                                                 double tolerance);

/// Scale for the norm of a projected gradient: the gradient at the starting point, but at least the gradient that residuals of
/// a negligible size cause. With this floor a search that starts at its optimum ends.
/// @param gradient J'r, @param jacobian (n_residuals × n), both at the starting point
/// @param negligible  in units of the residuals; by default relative frequencies, far below any measurement error
[[nodiscard]] double gradient_reference(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& jacobian,
                                        double negligible = 1e-4);

}  // namespace twindeck::updating
