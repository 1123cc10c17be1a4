#pragma once

#include <string>

#include "io/config.hpp"
#include "runner/run_step.hpp"
#include "sensors/layout.hpp"

namespace twindeck::steps {

struct SensorsConfig : sensors::LayoutSettings {
  std::string points, setups;  ///< files
  [[nodiscard]] io::FieldTable fields();
};

/// s2_sensors: scores of sensor setups, better ones, and the blind test (paper section 3.1, Table 3).
[[nodiscard]] runner::Computation read_sensors(runner::StepContext& context, const SensorsConfig& config);

}  // namespace twindeck::steps
