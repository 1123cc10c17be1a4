#pragma once

#include "steps/diagnosis/config.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// Runs the whole step.
[[nodiscard]] Status run_diagnosis(const DiagnosisConfig& config, StepContext& context);

}  // namespace twindeck::steps
