#pragma once

#include <string>

#include "identification/identification.hpp"

namespace twindeck::identification {

/// The configuration, with limits lowered to the channels and the shortest record of a setup: first blocks, then block rows,
/// then the largest order and the Welch segment. No limit is raised.
struct CarriedLimits {
  IdentificationSettings config;
  std::string note;  ///< which limits were lowered; empty for none
};
/// @throws UnusableRecord  if not even the smallest limits fit
[[nodiscard]] CarriedLimits carried_by(const Conditioned& conditioned, const IdentificationSettings& config);

}  // namespace twindeck::identification
