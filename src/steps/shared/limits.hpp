#pragma once

namespace twindeck::steps {

// Limits of what a configuration may ask for. Beyond them a number is a slip (milliseconds for seconds, a digit too many) that would fill
// the memory or never end.
constexpr double longest_record_s = 86400.0;  ///< [s] a day: ten times the longest ambient record that is usual
constexpr double highest_rate_Hz = 1e4;       ///< [Hz] hundred times what loggers of structures sample at
constexpr double lowest_rate_Hz = 1e-3;  ///< [Hz] a sample in a quarter of an hour: no structure swings a hundredth as slowly
constexpr double highest_wind_m_s = 200.0;    ///< [m/s] the fastest gust that was ever measured on the ground had 113 m/s (WMO, 1996)

}  // namespace twindeck::steps
