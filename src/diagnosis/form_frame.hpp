#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/features/form_columns.hpp"
#include "diagnosis/inference.hpp"
#include "diagnosis/inference/form_evidence.hpp"

/// Private to src/diagnosis: the residual of a fit as the linear model of diagnosis/inference/form_evidence.hpp.
namespace twindeck::diagnosis {

/// Keys of conditions.toml that tell the measured conditions apart, "state NAME" for each state after the first and, of three
/// and more, "from state NAME on" for each of them but the last.
[[nodiscard]] std::vector<Contrast> contrasts_of(const FeatureSet& features);

/// The contrast in which a candidate acts, -1 where it acts in all conditions alike.
[[nodiscard]] int contrast_of(const Candidate& candidate, const std::vector<Contrast>& contrasts);
/// All contrasts in which a candidate acts, that one first: friction goes by the amplitude and by the dampers.
[[nodiscard]] std::vector<int> contrasts_of(const Candidate& candidate, const std::vector<Contrast>& contrasts);

/// Columns, residual y - g + J x and Sigma_0 of the training rows at a fit. The coordinates of the last `tested` columns of the
/// fit's Jacobian are those of a cause under test: they become the signatures (per unit of its coordinates) and leave the
/// residual.
/// @param plain  with the covariance of identification alone
[[nodiscard]] FormSystem form_system(const Inference& plain, const Fit& fit, const std::vector<Contrast>& contrasts,
                                     Eigen::Index tested = 0);

/// Many small causes everywhere: the effects of all structural candidates of one size that act in all conditions alike.
/// Unknowns of unit deviation give the frequencies an RMS change of 1, of which every hypothesis has the same share (n_rows ×
/// n_candidates). A model is off for many small reasons, so a single cause has to explain the data better than these together.
/// They are those at the fit: beside its causes.
[[nodiscard]] Eigen::MatrixXd many_small_causes(const Inference& inference, const Fit& fit,
                                                const std::vector<Contrast>& contrasts);

/// Covariance of all rows from the form error at given scales, at a fit's structure (n_rows × n_rows).
[[nodiscard]] Eigen::MatrixXd form_covariance(const FeatureMap& map, const FeatureMap::Base& base,
                                              const std::vector<Cause>& causes, const Eigen::VectorXd& predicted,
                                              double frequency, double shape);

/// Columns of a system at fixed scales, each times its deviation: Sigma = Sigma_0 + C C'. @param kappa of `contrast`, 0 for
/// none
[[nodiscard]] Eigen::MatrixXd scaled_columns(const FormSystem& system, const ScaleGrid& grid, const ScalePoint& point,
                                             int contrast, double kappa);

}  // namespace twindeck::diagnosis
