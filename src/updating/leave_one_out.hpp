#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "updating/search.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {

/// How well an updated model predicts. Each target is left out of the updating in turn and the others are fitted. The frequency
/// of the left-out target at that optimum is a prediction, because it did not enter the fit.
///
/// Each search begins at the initial values, not at the optimum of all targets, which depends on the left-out one. Each search
/// has one start. The several starts of the whole update show whether one is enough. All searches use the modal basis of the
/// whole update.
///
/// @param initial (n_active) normalised initial values
/// @return (n_targets) in the order of the targets; empty with fewer than two of them
/// Reference: Stone (1974), J. R. Stat. Soc. B 36, 111-147.
[[nodiscard]] std::vector<LeftOut> leave_each_out(const Search& search, const Eigen::VectorXd& initial);

/// Mean absolute errors relative to the measured frequencies, over the targets.
struct PredictionErrors {
  double before = 0.0;    ///< of the start model
  double left_out = 0.0;  ///< mean error of the predictions, each target left out of the updating in turn
};

/// @param result  of an update with options.leave_one_out
/// @return nothing where no target was left out, or one was not predicted
[[nodiscard]] std::optional<PredictionErrors> prediction_errors(const UpdatingResult& result,
                                                                const std::vector<FrequencyTarget>& targets);

/// The update with the prior of the ranges (prior.hpp), again with each target left out in turn. It is made if the update
/// without a prior predicts left-out targets worse than the start model does. One search runs from the initial values: in a
/// model that is nearly linear over the ranges, the prior leaves one optimum.
/// @param found  the update without a prior; the other arguments as in `update`
/// @return null if the update without a prior predicts at least as well, or leave-one-out was not asked for
[[nodiscard]] std::shared_ptr<const UpdatingResult> regularised_where_worse(
    const UpdatingResult& found, const fe::ParametricSystem& start, const Refresh& refresh, const std::vector<int>& active,
    const std::vector<FrequencyTarget>& targets, UpdatingOptions options, const MeasuredRows& rows);

}  // namespace twindeck::updating
