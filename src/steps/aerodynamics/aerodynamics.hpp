#pragma once

#include "runner/run_step.hpp"
#include "steps/wind/aerodynamics_config.hpp"

/// Step 7: a model in mean wind (paper section 5.1, Tables 11, 12, Figs 16 to 20).
namespace twindeck::steps {

/// The step.
[[nodiscard]] runner::Computation read_aerodynamics(runner::StepContext& context, const AerodynamicsConfig& config);

}  // namespace twindeck::steps
