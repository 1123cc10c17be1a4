#pragma once

#include <Eigen/Core>
#include <vector>

#include "updating/search.hpp"

namespace twindeck::updating {

/// How well an updated model predicts. Each target is left out of the updating in turn and the others are fitted. The frequency
/// of the left-out target at that optimum is a prediction, because it did not enter the fit.
///
/// Each search begins at the initial values, not at the optimum of all targets, which depends on the left-out one. One start is
/// used; the starts of the whole update show whether that is enough. All searches use the modal basis of the whole update.
///
/// @param initial (n_active) normalised initial values
/// @return (n_targets) in the order of the targets; empty with fewer than two of them
/// Reference: Stone (1974), J. R. Stat. Soc. B 36, 111-147.
[[nodiscard]] std::vector<LeftOut> leave_each_out(const Search& search, const Eigen::VectorXd& initial);

}  // namespace twindeck::updating
