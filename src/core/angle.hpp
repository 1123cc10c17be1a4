#pragma once

#include <numbers>

namespace twindeck {

inline constexpr double degrees = 180.0 / std::numbers::pi;  ///< degrees in a radian
inline constexpr double radians = std::numbers::pi / 180.0;  ///< radians in a degree

}  // namespace twindeck
