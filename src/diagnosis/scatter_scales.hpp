#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// By how much errors of one kind are larger (or smaller) than stated, as the rows themselves say.
struct ScatterScale {
  std::string of;  ///< a row type ("frequency_Hz"), or "workmanship": elements, stays and gains of the model
  int rows = 0;    ///< of that type; for workmanship all
  double scale = 1.0, low = 1.0, high = 1.0;  ///< times the stated deviation, 90 % interval
};

/// Scales that maximise the marginal likelihood of the training rows at a fit's linearisation, where y - g + J x ~
/// N(0, s_t s_u Sigma_tu + J_p J_p' + s_w² J_w J_w'), t and u the types of two rows, p the parameters (and causes, whose priors
/// are theirs to state), w workmanship. By turns over the logarithms, each within a factor of five; intervals by the curvature,
/// so that a scale that the rows say nothing of has a wide one. They are told, and change no verdict: what is fitted to the
/// errors cannot be held against them. Reference: MacKay (1992), Neural Computation 4, 415-447 (evidence for hyperparameters).
[[nodiscard]] std::vector<ScatterScale> scatter_scales(const Inference& inference, const Fit& fit);

}  // namespace twindeck::diagnosis
