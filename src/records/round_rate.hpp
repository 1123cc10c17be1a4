#pragma once

#include <algorithm>
#include <cmath>

namespace twindeck::records {

/// The number with the fewest digits within 0.3 deviations. Loggers run at round rates, which the digits of stamps hide.
inline double round_rate(double rate, double deviation) {
  constexpr double round_to = 0.3;  // deviations
  const double tolerance = std::max(round_to * deviation, 1e-7 * rate);
  for (int digits = 1; digits < 12; ++digits) {
    const double unit = std::pow(10.0, std::floor(std::log10(rate)) + 1.0 - digits);
    const double round = unit >= 1.0 ? std::round(rate / unit) * unit : std::round(rate / unit) / std::round(1.0 / unit);
    if (std::abs(round - rate) <= tolerance) return round;
  }
  return rate;
}

}  // namespace twindeck::records
