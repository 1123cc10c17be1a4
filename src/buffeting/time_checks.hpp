#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"

namespace twindeck::buffeting {

/// An RMS two ways, of the vertical acceleration at a monitoring point.
struct TimeCheck {
  std::string name, channel;
  double reference_m_s2 = 0.0, found_m_s2 = 0.0, allowed_pct = 1.0;
};
/// An event and a run in it, whose wind the bridge stands.
struct CheckedCase {
  WindEvent event;
  ValidationRun run;
};
/// @param seed  of the gusts
/// `half_step`: one event and run, one seed, at half the time step. `full_model`: the same gust forces on the reduced
/// structure and on the whole finite element model, dampers included, from rest, both with the same Rayleigh damping and
/// without self-excited forces (which are forces of the strips alone, the same in both); left out where full_model_check is 0.
[[nodiscard]] std::vector<TimeCheck> check_time_integration(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                                            const WindEventSettings& config, const CheckedCase& checked,
                                                            std::uint64_t seed);

}  // namespace twindeck::buffeting
