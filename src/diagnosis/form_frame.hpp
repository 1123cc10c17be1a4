#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/features/form_columns.hpp"
#include "diagnosis/inference.hpp"

/// Private to src/diagnosis: contrasts between the measured conditions, and the form error as a covariance of rows.
namespace twindeck::diagnosis {

/// Contrasts between the measured conditions: keys of conditions.toml that differ, "state NAME" for each state after the first
/// and, with three and more states, "from state NAME on" for all of these but the last.
[[nodiscard]] std::vector<Contrast> contrasts_of(const FeatureSet& features);

/// The contrast in which a candidate acts, -1 if it acts equally in all conditions.
[[nodiscard]] int contrast_of(const Candidate& candidate, const std::vector<Contrast>& contrasts);
/// All contrasts in which a candidate acts, `contrast_of` first: friction depends on the amplitude and on the dampers.
[[nodiscard]] std::vector<int> contrasts_of(const Candidate& candidate, const std::vector<Contrast>& contrasts);

/// Covariance of all rows from the form error at given scales, at a fit's structure (n_rows × n_rows).
[[nodiscard]] Eigen::MatrixXd form_covariance(const FeatureMap& map, const FeatureMap::Base& base,
                                              const std::vector<Cause>& causes, const Eigen::VectorXd& predicted,
                                              double frequency, double shape);

}  // namespace twindeck::diagnosis
