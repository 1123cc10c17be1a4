#pragma once

#include <algorithm>
#include <vector>

namespace twindeck {

/// Half width of a Gaussian 90 % interval in standard deviations.
inline constexpr double kReachOfNinety = 1.645;

/// Median; for an even number of values the mean of the two middle ones. @param values  at least one
[[nodiscard]] inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// The upper one of the two middle values where their number is even. @param values  at least one
[[nodiscard]] inline double upper_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace twindeck
