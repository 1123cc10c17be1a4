#pragma once

#include <string>

#include "io/config.hpp"
#include "sensors/layout_settings.hpp"

namespace twindeck::steps {

/// Configuration of s2_sensors.
struct SensorsConfig : sensors::LayoutSettings {
  std::string points, setups;  ///< files

  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
