#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

struct EffectParameter {
  std::string name, unit;
  double value = 0.0, low = 0.0, high = 0.0;
  bool at_low_bound = false, at_high_bound = false;  ///< the interval reaches the prior's bound, and is a one-sided limit
};

/// 90 % intervals of the unknowns of one cause of a fit, from the profile likelihood of each unknown, widened by the remaining
/// misfit (Birge 1932).
[[nodiscard]] std::vector<EffectParameter> effect_parameters(const Inference& inference, const Fit& fit, std::size_t which);

/// Widens the intervals of sizes by a standard deviation of ln of the size (kg, |ln factor|), in quadrature, because the model
/// that gives the size is inaccurate.
void widen_sizes(std::vector<EffectParameter>& parameters, double deviation);

}  // namespace twindeck::diagnosis
