#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// Factor between the estimated and the stated standard deviation of one kind of error.
struct ScatterScale {
  std::string of;  ///< a row type ("frequency_Hz"), or "workmanship" for element scatter (elements, stays, gains)
  int rows = 0;    ///< number of rows of that type; for element scatter all
  double scale = 1.0, low = 1.0, high = 1.0;  ///< times the stated deviation, 90 % interval
};

/// Scales that maximise the marginal likelihood of the training rows at a fit's linearisation, where y - g + J x ~
/// N(0, s_t s_u Sigma_tu + J_p J_p' + s_w² J_w J_w'), t and u the types of two rows, p the parameters (and causes, with their
/// own priors), w element scatter. The logarithms are optimised in turn, each within a factor of five. Intervals follow from
/// the curvature, so a scale that the rows do not determine has a wide interval. The scales are reported and do not change the
/// verdict, because a scale fitted to the errors would explain them away.
/// Reference: MacKay (1992), Neural Computation 4, 415-447 (evidence for hyperparameters).
[[nodiscard]] std::vector<ScatterScale> scatter_scales(const Inference& inference, const Fit& fit);

}  // namespace twindeck::diagnosis
