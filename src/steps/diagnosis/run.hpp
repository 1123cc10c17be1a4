#pragma once

#include "steps/diagnosis/config.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// The step.
[[nodiscard]] Computation read_diagnosis(const DiagnosisConfig& config, StepContext& context);

}  // namespace twindeck::steps
