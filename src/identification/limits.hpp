#pragma once

#include <string>

#include "identification/identification.hpp"

namespace twindeck::identification {

/// The configuration as far as the shortest of a setup's records and its channels carry it. Blocks, block rows, the largest
/// order and the Welch segment become smaller, in this order of sacrifice; nothing becomes larger.
struct CarriedLimits {
  IdentificationSettings config;
  std::string note;  ///< which limits follow the record's length; empty if all stay
};
/// @throws UnusableRecord  if not even the smallest limits fit
[[nodiscard]] CarriedLimits carried_by(const Conditioned& conditioned, const IdentificationSettings& config);

}  // namespace twindeck::identification
