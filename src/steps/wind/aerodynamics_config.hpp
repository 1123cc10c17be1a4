#pragma once

#include "aero/wind_settings.hpp"
#include "io/config.hpp"

namespace twindeck::steps {

/// Configuration of s7_aerodynamics; steps 0 and 8 read the same file for the decks and the wind.
struct AerodynamicsConfig : aero::WindSettings {
  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
