#pragma once

#include <string>
#include <vector>

#include "identification/condition.hpp"

namespace twindeck::identification {

/// Doubts that a person should check before the modes are used: a mode with fewer than two periods in a block of its setup, a
/// damping ratio far from those of the other modes, a spectral peak without a mode.
/// @param result  identified @return one line each, empty for none
[[nodiscard]] std::vector<std::string> doubts_of(const ConditionResult& result);

}  // namespace twindeck::identification
