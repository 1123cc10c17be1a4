#include "records/split_time.hpp"

#include <algorithm>
#include <cmath>

#include "core/letters.hpp"
#include "records/text_cells.hpp"
#include "records/time_stamp.hpp"

namespace twindeck::records {

namespace {

constexpr TimeParts kNoParts = {-1, -1, -1, -1, -1, -1, -1, -1, -1};

/// Names of a part of a time, in lower case, and its range. A column named as year may have two digits.
struct Part {
  std::string_view names;
  double least, below;
};
constexpr std::array<Part, kTimeParts> kParts = {
    {{"|year|yyyy|yy|yr|jahr|anno|ano|annee|", 1970.0, 2100.0},
     {"|month|mon|mo|mm|monat|mese|mes|mois|", 1.0, 13.0},
     {"|day|dd|tag|giorno|dia|jour|doy|day of year|dayofyear|", 1.0, 367.0},
     {"|hour|hours|hh|hr|stunde|ora|ore|hora|heure|", 0.0, 25.0},
     {"|minute|minutes|min|mi|mn|mm|minuto|minuti|", 0.0, 60.0},
     {"|second|seconds|sec|ss|s|sekunde|secondo|secondi|segundo|seconde|", 0.0, 61.0},
     {"|ms|msec|millis|millisec|millisecond|milliseconds|millisekunde|millisecondi|", 0.0, 1e3},
     {"|us|usec|usecs|micros|microsec|microsecond|microseconds|", 0.0, 1e6},
     {"|ns|nsec|nsecs|nanos|nanosec|nanosecs|nanosecond|nanoseconds|", 0.0, 1e9}}};

/// Whether the columns of the parts hold possible values in each row.
bool hold_parts(const std::vector<std::vector<std::string_view>>& rows, const TimeParts& parts, bool decimal_comma,
                bool named) {
  return std::ranges::all_of(rows, [&](const std::vector<std::string_view>& cells) {
    for (std::size_t k = 0; k < kTimeParts; ++k) {
      if (parts[k] < 0) continue;
      const auto value = number_in(cells[static_cast<std::size_t>(parts[k])], decimal_comma);
      const double least = k == kYear && named ? 0.0 : kParts[k].least;
      if (!value || !(*value >= least && *value < kParts[k].below) || (k < kSecond && *value != std::floor(*value)))
        return false;
    }
    return true;
  });
}

TimeParts by_name(const std::vector<std::string>& names) {
  TimeParts parts = kNoParts;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::string name = lower_case(trimmed(names[c]));
    for (std::size_t k = 0; k < kTimeParts; ++k) {
      if (parts[k] >= 0 || !is_one_of(kParts[k].names, name)) continue;
      parts[k] = static_cast<int>(c);
      break;  // "MM" is the month, a later "mm" the minute
    }
  }
  return parts;
}

/// Whole seconds and a column with the rest of each, whose names differ in the last word alone.
std::optional<TimeParts> whole_seconds_and_rest(const std::vector<std::vector<std::string_view>>& rows,
                                                const std::vector<std::string>& names, bool decimal_comma) {
  const auto split = [&](std::size_t c) {
    const std::string name = lower_case(trimmed(names[c]));
    const std::size_t last = name.find_last_of("._/ ") + 1;
    return std::pair(name.substr(0, last), name.substr(last));
  };
  const auto holds = [&](std::size_t c, double below) {
    return std::ranges::all_of(rows, [&](const std::vector<std::string_view>& cells) {
      const auto value = number_in(cells[c], decimal_comma);
      return value && *value >= 0.0 && *value < below && *value == std::floor(*value);
    });
  };
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (!is_one_of("|s|sec|secs|second|seconds|", split(c).second)) continue;
    for (std::size_t rest = 0; rest < names.size(); ++rest)
      for (std::size_t k = kMillisecond; k < kTimeParts; ++k) {
        if (!is_one_of(kParts[k].names, split(rest).second) || split(rest).first != split(c).first) continue;
        if (!holds(c, HUGE_VAL) || !holds(rest, kParts[k].below)) continue;
        TimeParts parts = kNoParts;
        parts[kSecond] = static_cast<int>(c);
        parts[k] = static_cast<int>(rest);
        return parts;
      }
  }
  return {};
}

}  // namespace

std::optional<TimeParts> find_time_parts(const std::vector<std::vector<std::string_view>>& rows,
                                         const std::vector<std::string>& names, bool decimal_comma, bool stamped) {
  TimeParts parts = by_name(names);
  const int millisecond = parts[kMillisecond];
  const auto there = [&](std::size_t k) { return parts[k] >= 0; };
  if (stamped) {
    std::fill_n(parts.begin(), kMillisecond, -1);
    const bool rest = there(kMillisecond) || there(kMicrosecond) || there(kNanosecond);
    return rest && hold_parts(rows, parts, decimal_comma, true) ? std::optional(parts) : std::nullopt;
  }
  const bool time = there(kHour) && there(kMinute) && there(kSecond), date = there(kYear) && there(kDay);
  if (!date) std::fill_n(parts.begin(), kHour, -1);
  if (time && hold_parts(rows, parts, decimal_comma, true)) return parts;
  if (!there(kHour))
    if (const auto pair = whole_seconds_and_rest(rows, names, decimal_comma)) return pair;
  for (int c = 0; c + static_cast<int>(kSecond) < static_cast<int>(rows.front().size()); ++c) {
    for (const int year : {0, 2}) {
      parts = {c + year, c + 1, c + 2 - year, c + 3, c + 4, c + 5, millisecond, -1, -1};
      if (hold_parts(rows, parts, decimal_comma, false)) return parts;
    }
  }
  return {};
}

std::optional<double> seconds_of_parts(const std::vector<std::string_view>& cells, const TimeParts& parts, bool decimal_comma) {
  std::array<double, kTimeParts> value{};
  for (std::size_t k = 0; k < kTimeParts; ++k) {
    if (parts[k] < 0) continue;
    const auto number = number_in(cells[static_cast<std::size_t>(parts[k])], decimal_comma);
    if (!number || !std::isfinite(*number)) return {};
    value[k] = *number;
  }
  const double month = parts[kMonth] < 0 ? 1.0 : value[kMonth];
  const double days = parts[kYear] < 0 ? 0.0
                                       : days_since_1970(static_cast<int>(value[kYear]), static_cast<unsigned>(month),
                                                         static_cast<int>(value[kDay]));
  return 86400.0 * days + 3600.0 * value[kHour] + 60.0 * value[kMinute] + value[kSecond] + 1e-3 * value[kMillisecond] +
         1e-6 * value[kMicrosecond] + 1e-9 * value[kNanosecond];
}

}  // namespace twindeck::records
