#pragma once

#include "steps/sensors/sensors_config.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// s2_sensors: scores of sensor setups, better ones, and the blind test (paper section 3.1, Table 3).
[[nodiscard]] Computation read_sensors(StepContext& context, const SensorsConfig& config);

}  // namespace twindeck::steps
