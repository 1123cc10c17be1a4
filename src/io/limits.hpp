#pragma once

namespace twindeck::io {

// Limits of values in a configuration. A larger value is a typing or unit error (milliseconds for seconds) that would fill the
// memory or run without end.
constexpr double longest_record_s = 86400.0;  ///< [s] a day: ten times the longest ambient record that is usual
constexpr double highest_rate_Hz = 1e4;       ///< [Hz] hundred times what loggers of structures sample at
constexpr double lowest_rate_Hz =
    1e-3;  ///< [Hz] about one sample in a quarter of an hour, far slower than any structure vibrates
constexpr double highest_wind_m_s = 200.0;  ///< [m/s] the fastest gust measured at the ground was 113 m/s (WMO, 1996)

}  // namespace twindeck::io
