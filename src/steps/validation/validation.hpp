#pragma once

#include "runner/run_step.hpp"
#include "steps/validation/validation_config.hpp"

/// Step 8: the bridge in turbulent wind (paper sections 5.2 and 6, Tables 13, 14, Fig. 21).
namespace twindeck::steps {

/// The step.
[[nodiscard]] runner::Computation read_validation(runner::StepContext& context, const ValidationConfig& config);

}  // namespace twindeck::steps
