#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twindeck::records {

/// Parts of a time that stand in columns of their own.
enum TimePart : std::size_t {
  kYear,
  kMonth,
  kDay,
  kHour,
  kMinute,
  kSecond,
  kMillisecond,
  kMicrosecond,
  kNanosecond,
  kTimeParts
};

/// The column of each part, from 0; -1 for one that is not there.
using TimeParts = std::array<int, kTimeParts>;

/// Finds columns that hold the parts of a time. They are found by name ("Hour", "Minuto", "ss"; the date may be missing or hold
/// the day of the year), as are whole seconds with their rest ("header.stamp.sec", "header.stamp.nanosec"). Otherwise six
/// neighbouring columns with the values of a date (year first or day first) and a time are taken.
/// @param rows     cells of the table, one vector a row, all of one length
/// @param names    one a column, or none
/// @param stamped  the table has time stamps; then only a column of milliseconds (or µs, ns) is looked for
[[nodiscard]] std::optional<TimeParts> find_time_parts(const std::vector<std::vector<std::string_view>>& rows,
                                                       const std::vector<std::string>& names, bool decimal_comma, bool stamped);

/// [s] since 1970, or since midnight if there is no date. Empty if a part is no number.
[[nodiscard]] std::optional<double> seconds_of_parts(const std::vector<std::string_view>& cells, const TimeParts& parts,
                                                     bool decimal_comma);

}  // namespace twindeck::records
