#pragma once

#include "runner/run_step.hpp"
#include "steps/diagnosis/setup.hpp"

namespace twindeck::steps {

/// The step.
[[nodiscard]] runner::Computation read_diagnosis(const DiagnosisConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
