#pragma once

#include "updating/problem.hpp"

namespace twindeck::updating {

/// min 1/2 ‖r(x)‖² on a box by a change of variables: x = middle + half width · sin u, searched in u, which has no bounds. It
/// checks `minimise_on_box` by another method, without projection and without a set of active bounds. It converges slowly at
/// a bound (dx/du is zero there), so it is used as a check only.
/// @param start (n) inside the box; a component within a thousandth of the range of a bound starts that far inside
/// @return x and cost; `projected_gradient` is that of the bounded problem at x
/// Reference: James and Roos (1975), Computer Physics Communications 10, 343-367, section on limits of parameters.
[[nodiscard]] BoundedResult minimise_by_smooth_map(const ResidualFunction& function, int n_residuals,
                                                   const Eigen::VectorXd& start, const Box& box, const BoundedOptions& options);

}  // namespace twindeck::updating
