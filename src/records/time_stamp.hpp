#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace twindeck::records {

/// Seconds that a time stamp may mean, since 1970-01-01 (a time of day alone: since midnight). Several where day and month can
/// be exchanged: "03/04/2021 10:00:00" is 3 April or 4 March, the former first. Empty where the text is no time stamp. Read:
/// 2021-04-03T10:00:00.25Z, 03.04.2021 10:00:00,25, 4/3/2021 10:00:00 PM, 3-Apr-2021 10:00:00, April 3, 2021 10:00,
/// 20210403T100000.25, 10:00:00.25, and minutes 00:00.25 as Excel shows them, with blanks, 'T' or '_' between; behind them a
/// zone, whose offset (+02:00) is taken off a date's time.
[[nodiscard]] std::vector<double> time_stamp_meanings(std::string_view text);

/// Days from 1970-01-01 to a date of the calendar. @param year  of two digits: 1970 to 2069 @param month  1 to 12
[[nodiscard]] double days_since_1970(int year, unsigned month, int day);

/// "2021-04-03", "03.04.2021", "4/3/21", "3-Apr-2021": a date without a time.
[[nodiscard]] bool is_date(std::string_view cell);

/// Turns a column of time stamps into seconds, row by row. Of several meanings of a stamp and of the one before, it takes the
/// nearest two. So the order of day and month is kept over midnight, and loggers that exchange day and month on the first
/// twelve days of a month are put right.
class TimeStampReader {
 public:
  /// @return seconds, empty for no time stamp
  std::optional<double> next(std::string_view text);
  /// Number of rows whose usual meaning was not taken.
  [[nodiscard]] long exchanged() const { return exchanged_; }

 private:
  std::vector<double> last_;           ///< meanings of the last stamp
  std::size_t taken_ = 0, usual_ = 0;  ///< the one taken of them, and of the first stamps
  double shift_ = 0.0;                 ///< [s] of the meanings now taken to those of the first stamps
  double hours_ = 0.0;                 ///< [s] full hours passed, for stamps of minutes and seconds
  long exchanged_ = 0;
};

}  // namespace twindeck::records
