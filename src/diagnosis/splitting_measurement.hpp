#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// The measurement that would tell the first two members of a set apart: another condition, a second sensor, or the node where
/// their mode shapes differ most. Empty for a set of one.
[[nodiscard]] std::string splitting_measurement(const Inference& inference, const Fit& base,
                                                const std::vector<const Scored*>& members);

}  // namespace twindeck::diagnosis
