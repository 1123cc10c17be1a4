#pragma once

#include <string>
#include <vector>

#include "buffeting/wind_event_settings.hpp"
#include "io/config.hpp"

namespace twindeck::steps {

/// Configuration of s8_validation; decks, data, direction and damping are those of s7_aerodynamics.toml.
struct ValidationConfig : buffeting::WindEventSettings {
  std::string aerodynamics;  ///< file of step 7's configuration; empty: the study's
  std::string set = "standin";
  std::string turbulence_file = "data/wind/turbulence_sets.csv", turbulence_set = "printed";
  std::string spectrum = "von_karman", spectrum_file, coherence = "exponential", coherence_file;
  std::vector<double> decay_v, decay_u, decay_w;  ///< along, across, vertical; empty: the set's
  double davenport_decay = 7.0;
  double sensor_tolerance_m = 0.5;  ///< largest distance of a measured channel from the point of its name

  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
