#pragma once

#include <optional>
#include <string_view>

namespace twindeck::records {

/// Sampling rate [Hz] that a header line of a text file states: "Sampling rate; 200 Hz", "fs=100", "dt [ms] 5", "Abtastrate:
/// 0,1 kHz", "sampling interval = 5e-3 s"; nothing where it states none.
[[nodiscard]] std::optional<double> rate_in_header_line(std::string_view line);
/// Number of samples that a line of a header states, as "NPTS= 4000" or "4000 samples"; empty where it states none.
[[nodiscard]] std::optional<long> samples_in_header_line(std::string_view line);

/// A column's name that means time: `time`, `Time_s`, `t`, `Zeit`, `timestamp`, `elapsed (s)`, … as a word of the name.
[[nodiscard]] bool is_time_name(std::string_view name);

}  // namespace twindeck::records
