#pragma once

#include "runner/run_step.hpp"
#include "steps/sensors/sensors_config.hpp"

namespace twindeck::steps {

/// s2_sensors: scores of sensor setups, better ones, and the blind test (paper section 3.1, Table 3).
[[nodiscard]] runner::Computation read_sensors(runner::StepContext& context, const SensorsConfig& config);

}  // namespace twindeck::steps
