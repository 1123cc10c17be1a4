#pragma once

#include "runner/run_step.hpp"
#include "steps/wind/validation_config.hpp"

/// Step 8 (paper sections 5.2 and 6, Tables 13, 14, Fig. 21).
namespace twindeck::steps {

/// Simulates all events and writes the tables. A run in which the bridge is unstable has a warning and empty rows. If every run
/// of every event is unstable, the status is not converged.
/// @throws InputError  for inputs that are missing or do not fit together
[[nodiscard]] runner::Computation read_validation(const ValidationConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
