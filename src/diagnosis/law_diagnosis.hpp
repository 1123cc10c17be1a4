#pragma once

#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

/// Diagnosis by the one law: errors of the model, of the sensors and of what changed have scales that are estimated under each
/// hypothesis; one table gives the verdict.
[[nodiscard]] Diagnosis diagnose_by_law(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed);

}  // namespace twindeck::diagnosis
