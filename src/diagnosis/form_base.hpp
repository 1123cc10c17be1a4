#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// A feature map with the form error in its rows' covariance.
/// @param predicted  rows at `base`, transformed as `FeatureMap::values` (n_rows) @param frequency, shape  form errors [-]
[[nodiscard]] FeatureMap with_form_error(const FeatureMap& plain, const FeatureMap::Base& base,
                                         const Eigen::VectorXd& predicted, double frequency, double shape);

/// Measured modes that no mode of the model resembles.
struct Strangers {
  std::vector<std::string> labels;  ///< as in rows.csv
  int rows = 0, shapes = 0;         ///< in all conditions together
};

/// A feature map in which strangers count for nothing. One such mode, a hybrid with a mode that the channels do not see, would
/// outweigh all others.
/// @param prior, predicted  the model as it stands, its rows @param form_error  that the fit stands [-] @param strangers filled
[[nodiscard]] FeatureMap without_strangers(const Inference& whole, const FeatureMap::Base& prior,
                                           const Eigen::VectorXd& predicted, double form_error, Strangers& strangers);

/// The structure as its plainest conditions show it: the first state; where there is one state, the least amplitude, wind and
/// number of people, no dampers, and the highest temperature, since bearings slip at large amplitudes and freeze in the cold.
/// Rows of the others say what changed, and a compromise between states, or between a bearing that holds and one that slips,
/// would be neither of them.
[[nodiscard]] Fit first_fit(const Inference& informed);

}  // namespace twindeck::diagnosis
