#pragma once

#include <cstdint>

#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

/// Finds what is wrong, why, and the gain from naming it (docs/diagnosis.md) by one law. Errors of the model, of the sensors
/// and of changes have scales that are estimated under each hypothesis. One table gives the verdict. The result is
/// deterministic: `seed` sets the resampling of left-out modes and held-out blocks.
[[nodiscard]] Diagnosis diagnose(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed);

}  // namespace twindeck::diagnosis
