#pragma once

#include <Eigen/Core>
#include <vector>

#include "updating/search.hpp"

namespace twindeck::updating {

/// How well an updated model predicts: each target is left out of the updating in turn, the others are fitted, and the
/// frequency of the left-out one at that optimum is a prediction, since nothing of it entered.
///
/// Each update is searched from the initial values, as its user would: the optimum of all targets knows the one that is left
/// out. That one start is enough is what the starts of the whole update show. The modal basis of the whole update serves all
/// searches.
///
/// @param initial (n_active) normalised initial values
/// @return (n_targets) in the order of the targets; empty with fewer than two of them
/// Reference: Stone (1974), J. R. Stat. Soc. B 36, 111-147.
[[nodiscard]] std::vector<LeftOut> leave_each_out(const Search& search, const Eigen::VectorXd& initial);

}  // namespace twindeck::updating
