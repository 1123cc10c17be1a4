#pragma once

#include "updating/problem.hpp"

namespace twindeck::updating {

/// min 1/2 ‖r(x)‖² on a box without telling the search of it: x = middle + half width · sin u, searched in u, which has no
/// bounds. A second opinion on `minimise_on_box`, by another route to the bounds: nothing is projected and no set of active
/// bounds is guessed. It creeps where a bound is met (dx/du vanishes there), so that it serves as a check and not as the
/// search.
/// @param start (n) inside the box; a component within a thousandth of the range of a bound starts that far inside
/// @return x and cost; `projected_gradient` is that of the bounded problem at x
/// Reference: James and Roos (1975), Computer Physics Communications 10, 343-367, section on limits of parameters.
[[nodiscard]] BoundedResult minimise_by_smooth_map(const ResidualFunction& function, int n_residuals,
                                                   const Eigen::VectorXd& start, const Box& box, const BoundedOptions& options);

}  // namespace twindeck::updating
