#pragma once

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

constexpr double kAside = 10.0;  ///< deviation of rows that are set aside: e^10, far beyond any change

/// Form errors of frequencies (ln f) and of shapes (decision 0013) [-].
struct FormLevel {
  double frequency = 0.0, shape = 0.0;
};

/// A feature map with the form error in its rows' covariance.
/// @param predicted  rows at `base`, transformed as `FeatureMap::values` (n_rows)
[[nodiscard]] FeatureMap with_form_error(const FeatureMap& plain, const FeatureMap::Base& base,
                                         const Eigen::VectorXd& predicted, const FormLevel& level);

/// The least of three form errors that fits can stand. Where the model is grossly off in its plainest conditions (chi² above
/// ten times the degrees of freedom) they stand the least level at which chi² is at most twice the degrees of freedom, else the
/// largest: a fit that stands less than the model is off by bends all parameters towards shapes that no model of its kind has.
/// Reference for that rule, the discrepancy principle: Morozov (1966), Soviet Mathematics 7, 414-417.
/// @param prior, predicted  the model as it stands, its rows
[[nodiscard]] FormLevel level_of_fits(const Inference& whole, const FeatureMap::Base& prior, const Eigen::VectorXd& predicted);

/// The structure as its plainest conditions show it: the first state; where there is one state, the least amplitude, wind and
/// number of people, no dampers, and the highest temperature, since bearings slip at large amplitudes and freeze in the cold.
/// Rows of the others say what changed, and a compromise between states, or between a bearing that holds and one that slips,
/// would be neither of them.
/// Measured modes that have more evidence as none of the model's do not bend it (law_openings.hpp).
[[nodiscard]] Fit first_fit(const Inference& plain, const Inference& informed);

}  // namespace twindeck::diagnosis
