#pragma once

#include <cmath>

/// Where a clock that people read turns: the minute of hhmmss, the end of summer time.
namespace twindeck::records {

/// Seconds since midnight of a time of day as one number: 235959.5 gives 86399.5.
[[nodiscard]] inline double seconds_of_digits(double hhmmss) {
  const double hours_and_minutes = std::floor(hhmmss / 100.0);
  return hhmmss - 40.0 * hours_and_minutes - 2400.0 * std::floor(hours_and_minutes / 100.0);
}

/// An hour in the unit of two stamps if the second begins the hour that the first ends: summer time is over. 0 otherwise.
[[nodiscard]] inline double hour_again(double before, double stamp) {
  constexpr double near = 2.0 / 3600.0;  // of an hour: whole seconds, and a late row
  for (const double hour : {3600.0, 3600e3, 3600e6, 1.0 / 24.0}) {
    const double begin = hour * std::floor(stamp / hour);
    if (before > begin + (1.0 - near) * hour && before <= begin + hour && stamp < begin + near * hour) return hour;
  }
  return 0.0;
}

}  // namespace twindeck::records
