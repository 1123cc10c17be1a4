#pragma once

#include "steps/reliability/inputs.hpp"

/// Step 10: reliability under wind.
namespace twindeck::steps {

/// Critical speeds without and with dampers, then comfort in turbulence at each speed; writes all tables.
[[nodiscard]] Status run_reliability(const ReliabilityConfig& config, const ReliabilityInputs& read,
                                     runner::StepContext& context);

}  // namespace twindeck::steps
