#pragma once

#include "runner/run_step.hpp"
#include "steps/validation/inputs.hpp"
#include "steps/wind/validation_config.hpp"

/// Step 8 (paper sections 5.2 and 6, Tables 13, 14, Fig. 21).
namespace twindeck::steps {

/// Simulates all events and writes the tables. Of a run in which the bridge is unstable there is a warning and empty rows.
/// @return not converged, and nothing is written, where that holds for every run of every event
[[nodiscard]] Status run_validation(const ValidationConfig& config, const ValidationInputs& read, runner::StepContext& context);

}  // namespace twindeck::steps
