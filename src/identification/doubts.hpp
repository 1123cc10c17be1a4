#pragma once

#include <string>
#include <vector>

#include "identification/condition.hpp"

namespace twindeck::identification {

/// What a person should look at before the modes are used: a mode whose two periods are longer than a block of its setup, a
/// damping ratio far from those of the other modes, a peak of the spectrum without a mode.
/// @param result  identified @return one line each, empty for none
[[nodiscard]] std::vector<std::string> doubts_of(const ConditionResult& result);

}  // namespace twindeck::identification
