#pragma once

#include "runner/run_step.hpp"
#include "steps/wind/validation_config.hpp"

/// Step 8 (paper sections 5.2 and 6, Tables 13, 14, Fig. 21).
namespace twindeck::steps {

/// The step: simulates all events and writes the tables. Of a run in which the bridge is unstable there is a warning and empty
/// rows; where that holds for every run of every event, it has not converged.
[[nodiscard]] runner::Computation read_validation(const ValidationConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
