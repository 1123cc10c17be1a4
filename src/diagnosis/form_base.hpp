#pragma once

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

constexpr double kAside = 10.0;  ///< deviation of excluded rows: e^10, far above any change

/// Form errors of frequencies (ln f) and of shapes (decision 0013) [-].
struct FormLevel {
  double frequency = 0.0, shape = 0.0;
};

/// A feature map with the form error in its rows' covariance.
/// @param predicted  rows at `base`, transformed as `FeatureMap::values` (n_rows)
[[nodiscard]] FeatureMap with_form_error(const FeatureMap& plain, const FeatureMap::Base& base,
                                         const Eigen::VectorXd& predicted, const FormLevel& level);

/// The form error that fits assume, the least of three levels. If the model is grossly wrong in its plainest conditions (chi²
/// above ten times the degrees of freedom), it is the least level at which chi² is at most twice the degrees of freedom, or
/// else the largest. A smaller form error would bend all parameters towards shapes that such a model cannot have.
/// Reference for that rule, the discrepancy principle: Morozov (1966), Soviet Mathematics 7, 414-417.
/// @param prior, predicted  the unchanged model, its rows
[[nodiscard]] FormLevel level_of_fits(const Inference& whole, const FeatureMap::Base& prior, const Eigen::VectorXd& predicted);

/// Fit of the structure to its plainest conditions. With several states this is the first state. With one state it is the least
/// amplitude, wind and number of people, no dampers, and the highest temperature, because bearings slip at large amplitudes and
/// freeze in the cold. Rows of other conditions show changes. A fit to all would be a compromise, for example between a bearing
/// that holds and one that slips. Measured modes that probably are none of the model's do not influence it (law_openings.hpp).
[[nodiscard]] Fit first_fit(const Inference& plain, const Inference& informed);

}  // namespace twindeck::diagnosis
