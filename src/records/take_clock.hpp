#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "core/samples.hpp"
#include "records/record.hpp"
#include "records/record_clock.hpp"

namespace twindeck::records {

/// Enters what the time stamps of a file say: rate with its deviation, gaps and repeats with place and length, as notes too.
/// The same for every format.
/// @param source  what holds the stamps, for people: "time column 'time'"
/// @param unit_s  [s] of the stamps, 0 where the file does not say
void take_clock(const StampedRows& stamps, double unit_s, const std::string& source, RecordInfo& info);

/// Enters a rate that a header, a scalar or an attribute states. Time stamps take precedence, unless both agree.
void take_stated_rate(double rate_Hz, const std::string& source, RecordInfo& info);

/// [s] of a unit of time by its name ("ms", "µs", "sec" …); 0 for any other.
[[nodiscard]] double time_unit_s(const std::string& unit);

/// A name without the unit of time at its end ("time_ms", "dt (us)"), and that unit [s], also of "ms of day"; 0 where it has
/// none.
[[nodiscard]] std::pair<std::string, double> without_time_unit(const std::string& name);

/// "sample 1000 (line 1002)" of a row of the file: its place among the samples, gaps counted.
[[nodiscard]] std::string place_of(const RecordInfo& info, Eigen::Index row);

/// Line of a row in a text file, 0 where it has none.
[[nodiscard]] long line_of(const RecordInfo& info, Eigen::Index row);

/// The samples with rows of NaN where the clock has gaps, and without rows that are there twice.
/// @param samples  (rows of the file × columns)
/// @throws InputError  if more samples are missing than there are; for rows whose time was there before and whose values differ
/// from those that had it: nobody can tell which are right
[[nodiscard]] Samples on_the_clock(Samples samples, const RecordInfo& info, const std::filesystem::path& file);

}  // namespace twindeck::records
