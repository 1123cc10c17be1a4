#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twindeck::records {

/// Parts of a time that stand in columns of their own.
enum TimePart : std::size_t { kYear, kMonth, kDay, kHour, kMinute, kSecond, kMillisecond, kTimeParts };

/// The column of each part, from 0; -1 for one that is not there.
using TimeParts = std::array<int, kTimeParts>;

/// Finds a time in columns of its parts, by their names ("Hour", "Minuto", "ss", the date may be missing or hold the day of the
/// year) or, whatever they are called, in six neighbours that hold year, month, day or day, month, year and then the time.
/// @param rows     cells of the table, one vector a row, all of one length
/// @param names    one a column, or none
/// @param stamped  the table has time stamps: then a column of milliseconds beside them is the only part
[[nodiscard]] std::optional<TimeParts> find_time_parts(const std::vector<std::vector<std::string_view>>& rows,
                                                       const std::vector<std::string>& names, bool decimal_comma, bool stamped);

/// [s] since 1970, without a date since midnight, by the parts that are there; empty where one of them is no number.
[[nodiscard]] std::optional<double> seconds_of_parts(const std::vector<std::string_view>& cells, const TimeParts& parts,
                                                     bool decimal_comma);

}  // namespace twindeck::records
