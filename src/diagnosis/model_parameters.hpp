#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

/// A parameter of the model in its own unit with its 90 % interval.
struct ParameterEstimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// A free parameter in the model fitted within its bounds, and in the extended model.
struct ModelParameter {
  std::string name, unit;
  ParameterEstimate before, after;
};

/// Every parameter that the fits may move, in the order of the model.
///
/// Intervals are Gaussian about the maximum a posteriori estimate: posterior covariance I - J' Sigma_tot^-1 J in units of the
/// prior, widened by the misfit that is left (Birge 1932), cut at the parameter's bounds. A cause that scales the parameter
/// itself is part of `after`, whose value may then lie beyond the bounds and whose interval holds the deviations of both.
[[nodiscard]] std::vector<ModelParameter> model_parameters(const Inference& inference, const Diagnosis& result);

}  // namespace twindeck::diagnosis
