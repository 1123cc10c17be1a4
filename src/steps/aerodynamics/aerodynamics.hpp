#pragma once

#include "steps/aerodynamics/config.hpp"
#include "steps/aerodynamics/wind_model.hpp"
#include "steps/shared/run_step.hpp"

/// Step 7: a model in mean wind (paper section 5.1, Tables 11, 12, Figs 16 to 20). Set-up that step 8 shares.
namespace twindeck::steps {

/// The step.
[[nodiscard]] Computation read_aerodynamics(StepContext& context, const AerodynamicsConfig& config);

}  // namespace twindeck::steps
