#pragma once

#include <algorithm>
#include <vector>

namespace twindeck {

/// Standard deviations that a Gaussian 90 % interval reaches to either side.
inline constexpr double kReachOfNinety = 1.645;

/// Middle value, the mean of the two middle ones of an even number. @param values  at least one
[[nodiscard]] inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace twindeck
