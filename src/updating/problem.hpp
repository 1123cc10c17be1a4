#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "updating/optimality.hpp"

namespace twindeck::updating {

/// Residuals r(x) and, if the pointer is not null, their Jacobian. Returns false if they do not exist; the step is then
/// refused.
/// @param x (n) @param residual (n_residuals) @param jacobian (n_residuals × n)
using ResidualFunction = std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian)>;

struct BoundedOptions {
  double trust_radius = 2.0;
  int max_iterations = 100;          ///< accepted and refused steps together, over all rounds
  double gradient_tolerance = 1e-6;  ///< absolute norm of the projected gradient at which the search ends
  double bound_tolerance = 1e-6;     ///< see `on_bound`
  double residual_unit = 1.0;  ///< residuals are divided by it during the search, so that the small constants of the search
                               ///< suit residuals of any size
};

/// One accepted step (number 0: the starting point).
struct AcceptedStep {
  int iteration = 0;
  double cost = 0.0, projected_gradient = 0.0, step = 0.0, radius = 0.0;
  Eigen::VectorXd x;
};

struct BoundedResult {
  Eigen::VectorXd x;  ///< (n) inside the box
  double cost = 0.0;  ///< 1/2 ‖r‖²
  double projected_gradient = 0.0;
  int iterations = 0;
  bool converged = false;
  std::string message;
};

/// min 1/2 ‖r(x)‖² on a box by Powell's dogleg (Ceres, TRADITIONAL_DOGLEG), spherical trust region in x as in Madsen, Nielsen
/// and Tingleff (2004), algorithm 3.21.
///
/// Ceres projects each dogleg step onto the box. With several active bounds such a step may not descend, and the trust region
/// then collapses before the optimum is reached. The search therefore runs in rounds. Components that stay on their bound are
/// constants of the round (SubsetManifold); the bounded linearised problem predicts them (bounded_quadratic.hpp). A round ends
/// as soon as a component meets a bound. The next round predicts the constants anew and releases those whose multiplier will
/// change sign. The norm of the projected gradient alone decides convergence, not the verdict of Ceres. Accepted steps never
/// raise the cost by more than its rounding. A step that would gain less than the rounding is judged by the projected gradient,
/// so that the search ends at the same point on every processor.
/// @param accepted  called for each accepted step, may be empty
[[nodiscard]] BoundedResult minimise_on_box(const ResidualFunction& function, int n_residuals, const Eigen::VectorXd& start,
                                            const Box& box, const BoundedOptions& options,
                                            const std::function<void(const AcceptedStep&)>& accepted);

/// min 1/2 ‖r(x)‖² on a box by a change of variables: x = middle + half width · sin u, searched in u, which has no bounds. It
/// checks `minimise_on_box` by another method, without projection and without a set of active bounds. It converges slowly at
/// a bound (dx/du is zero there), so it is used as a check only.
/// @param start (n) inside the box; a component within a thousandth of the range of a bound starts that far inside
/// @return x and cost; `projected_gradient` is that of the bounded problem at x
/// Reference: James and Roos (1975), Computer Physics Communications 10, 343-367, section on limits of parameters.
[[nodiscard]] BoundedResult minimise_by_smooth_map(const ResidualFunction& function, int n_residuals,
                                                   const Eigen::VectorXd& start, const Box& box, const BoundedOptions& options);

}  // namespace twindeck::updating
