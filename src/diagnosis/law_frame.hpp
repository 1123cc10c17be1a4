#pragma once

#include <vector>

#include "diagnosis/features/form_columns.hpp"
#include "diagnosis/inference.hpp"
#include "diagnosis/inference/one_law.hpp"

/// Private to src/diagnosis: the residual of a fit under one law (diagnosis/inference/one_law.hpp).
namespace twindeck::diagnosis {

/// Classes of errors, in the order of a LawSystem. One class for each contrast follows.
enum LawClass : int { kFrequencies, kShapes, kKinks, kGains, kElements, kFirstContrast };

constexpr double kUnitOfClasses = 0.01;  ///< [-] for a scale of 1: about the error of a carefully fitted model

/// The system of a fit, with the modes for its form errors.
struct FitSystem : LawSystem {
  FormModes modes;
  std::vector<bool> unpaired;  ///< (n_measured_modes) left open by the pairing
};

/// Residual y - g + J x and classes of the training rows at a fit. Units of the classes: 1 % of each model mode's frequency; a
/// random symmetric stiffness of 1 % in the model's modes; 0.25 % of a shape's norm at each mode and channel; 1 % of each
/// channel's gain; the stated scatter of elements. The class of a contrast has the columns of frequencies, shapes and kinks
/// together, weighted by the contrast. Sigma_0 holds the errors of identification, free scales of shapes, parameters with their
/// priors, rotations of close modes, and accepted causes. Without contrasts it holds the element scatter too: a wider scatter
/// of elements and a cause in an element then say the same, and only the stated scatter decides between them. The coordinates
/// of the last `tested` causes of the fit become the signatures (per unit of their coordinates) and leave the residual. A
/// contrast whose weights are all zero has no columns.
/// @param plain  with the covariance of identification alone
[[nodiscard]] FitSystem law_system(const Inference& plain, const Fit& fit, const std::vector<Contrast>& contrasts,
                                   std::size_t tested = 0);

/// Variance of the rows of a measured mode without a mode of the model, wide enough for any mode of the band; 0 for all other
/// rows (n_rows).
[[nodiscard]] Eigen::VectorXd variance_of_open(const FeatureMap& map, const MeasuredMode& mode);
/// ln prior probability that a measured mode is none of the model's.
[[nodiscard]] double log_prior_of_open();

/// Whether 16 digits suffice for a system: its columns, in deviations of their rows, must not hide the unknowns' own variance
/// of one. The test fails for an extended model with meaningless derivatives, and for rows measured to a part in a million.
[[nodiscard]] bool can_be_weighed(const LawSystem& system);

}  // namespace twindeck::diagnosis
