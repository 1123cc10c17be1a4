#pragma once

#include <Eigen/Core>
#include <vector>

#include "updating/search.hpp"

namespace twindeck::updating {

/// How well an updated model predicts: each target is left out of the updating in turn, the others are fitted, and the
/// frequency of the left-out one at that optimum is a prediction, since nothing of it entered.
///
/// Each update is searched from two points: from the initial values, and from the optimum of all targets, which lies near. The
/// cheaper end is taken; where both ends cost the same to 0.1 % (the fitted targets leave directions open along which the cost
/// stays), the one from the initial values, because the other start knows the left-out target. `LeftOut::range_Hz` is then how
/// far apart the two predictions lie. The modal basis of the whole update serves all searches.
///
/// @param initial (n_active) normalised initial values  @param optimum (n_active) of all targets
/// @return (n_targets) in the order of the targets; empty with fewer than two of them
/// Reference: Stone (1974), J. R. Stat. Soc. B 36, 111-147.
[[nodiscard]] std::vector<LeftOut> leave_each_out(const Search& search, const Eigen::VectorXd& initial,
                                                  const Eigen::VectorXd& optimum);

}  // namespace twindeck::updating
