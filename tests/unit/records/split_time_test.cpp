// Oracle: tables whose time stands in several columns, written from seconds since 1970 at 50.4 Hz over midnight and a year's
// end.
#include "records/split_time.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "records/record.hpp"
#include "scratch.hpp"

namespace twindeck::records {
namespace {

struct PartsOfTime {
  int year, month, day, of_year, hour, minute, second, ms;
};

constexpr int kSplitRows = 1500;
constexpr double kSplitRate_Hz = 50.4;

PartsOfTime parts_at(int row) {
  using namespace std::chrono;
  const auto at = sys_days(2023y / December / 31) + 86390s + milliseconds(std::lround(1e3 * row / kSplitRate_Hz));
  const auto date = floor<days>(at);
  const year_month_day ymd(date);
  const hh_mm_ss time(at - date);
  return {static_cast<int>(ymd.year()),
          static_cast<int>(static_cast<unsigned>(ymd.month())),
          static_cast<int>(static_cast<unsigned>(ymd.day())),
          static_cast<int>((date - sys_days(ymd.year() / 1 / 1)).count()) + 1,
          static_cast<int>(time.hours().count()),
          static_cast<int>(time.minutes().count()),
          static_cast<int>(time.seconds().count()),
          static_cast<int>(time.subseconds().count())};
}

/// A table of two channels, whose rows begin as `begin` gives them.
template <typename Begin>
std::string split_table(const std::string& names, const std::string& separator, const Begin& begin) {
  std::string text = names.empty() ? "" : names + separator + "P1" + separator + "P2\n";
  for (int t = 0; t < kSplitRows; ++t) {
    text += begin(parts_at(t)) + fmt::format("{}{:.4f}{}{:.4f}\n", separator, std::sin(0.37 * t), separator, std::sin(0.7 * t));
  }
  return text;
}

void expect_split_clock(const std::string& text, const std::string& what) {
  const Scratch scratch;
  const Record record = read(scratch.write("a.csv", text));
  ASSERT_EQ(record.info.channels.size(), 2U) << what;
  EXPECT_EQ(record.info.channels.front().name == "P1" || record.info.channels.front().name.starts_with("column"), true) << what;
  EXPECT_NEAR(record.info.rate_Hz, kSplitRate_Hz, 0.001) << what;
  EXPECT_TRUE(record.info.clock.gaps.empty()) << what;
  EXPECT_NEAR(record.samples(1400, 1), std::sin(0.7 * 1400), 1e-4) << what;
}

TEST(SplitTime, WholeSecondsAndTheirRest) {
  const auto pair = [](double per_s) {
    return [per_s](const PartsOfTime& s) {
      return fmt::format("{},{}", 1704067190 + (s.day == 1 ? 10 : 0) + (s.day == 1 ? 60 * s.minute + s.second : s.second - 50),
                         std::lround(1e-3 * s.ms * per_s));
    };
  };
  expect_split_clock(split_table("sec,nanosec", ",", pair(1e9)), "ROS 2");
  expect_split_clock(split_table("field.header.stamp.secs,field.header.stamp.nsecs", ",", pair(1e9)), "ROS 1");
  expect_split_clock(split_table("tv_sec,tv_usec", ",", pair(1e6)), "timeval");
}

TEST(SplitTime, SixColumnsByNameOrWithout) {
  const auto ymd = [](const PartsOfTime& s) {
    return fmt::format("{},{},{},{},{},{}.{:03}", s.year, s.month, s.day, s.hour, s.minute, s.second, s.ms);
  };
  expect_split_clock(split_table("Year,Month,Day,Hour,Minute,Second", ",", ymd), "named");
  expect_split_clock(split_table("Jahr,Monat,Tag,Stunde,Minute,Sekunde", ",", ymd), "German");
  expect_split_clock(split_table("a,b,c,d,e,f", ",", ymd), "names that say nothing");
  expect_split_clock(split_table("", ",", ymd), "no names");
  expect_split_clock(split_table("", " ",
                                 [](const PartsOfTime& s) {
                                   return fmt::format("{} {} {} {:02} {:02} {:02}.{:03}", s.day, s.month, s.year, s.hour,
                                                      s.minute, s.second, s.ms);
                                 }),
                     "day first");
  expect_split_clock(split_table("YY;MM;DD;hh;mm;ss", ";",
                                 [](const PartsOfTime& s) {
                                   return fmt::format("{};{};{};{};{};{},{:03}", s.year % 100, s.month, s.day, s.hour, s.minute,
                                                      s.second, s.ms);
                                 }),
                     "year of two digits, decimal comma");
}

TEST(SplitTime, MoreOrFewerPartsThanSix) {
  expect_split_clock(split_table("YYYY,MM,DD,hh,mm,ss,ms", ",",
                                 [](const PartsOfTime& s) {
                                   return fmt::format("{},{},{},{},{},{},{}", s.year, s.month, s.day, s.hour, s.minute,
                                                      s.second, s.ms);
                                 }),
                     "milliseconds");
  expect_split_clock(split_table("Year,DOY,Hour,Min,Sec", ",",
                                 [](const PartsOfTime& s) {
                                   return fmt::format("{},{},{},{},{}.{:03}", s.year, s.of_year, s.hour, s.minute, s.second,
                                                      s.ms);
                                 }),
                     "day of the year");
  expect_split_clock(
      split_table("Hour,Minute,Second", ",",
                  [](const PartsOfTime& s) { return fmt::format("{},{},{}.{:03}", s.hour, s.minute, s.second, s.ms); }),
      "no date");
  expect_split_clock(split_table("Time,ms", ",",
                                 [](const PartsOfTime& s) {
                                   return fmt::format("{}/{:02}/{:02} {:02}:{:02}:{:02},{}", s.year, s.month, s.day, s.hour,
                                                      s.minute, s.second, s.ms);
                                 }),
                     "stamps with their milliseconds in a column");
}

TEST(SplitTime, ADateApartFromItsTime) {
  const Scratch scratch;
  for (const bool date_first : {true, false}) {
    std::string text = date_first ? "Date,P1,P2,Time\n" : "Time,P1,P2,Date\n";
    for (int t = 0; t < kSplitRows; ++t) {
      const PartsOfTime s = parts_at(t);
      const std::string date = fmt::format("{:02}.{:02}.{}", s.day, s.month, s.year),
                        time = fmt::format("{:02}:{:02}:{:02}.{:03}", s.hour, s.minute, s.second, s.ms);
      text += fmt::format("{},{:.4f},{:.4f},{}\n", date_first ? date : time, std::sin(0.37 * t), std::sin(0.7 * t),
                          date_first ? time : date);
    }
    expect_split_clock(text, date_first ? "date first" : "date last");
  }
}

TEST(SplitTime, DateAndTimeThatLookLikeNumbers) {
  for (const char* sign : {"", ":"}) {
    expect_split_clock(split_table("Date,Time", ",",
                                   [&](const PartsOfTime& s) {
                                     return fmt::format("{}{:02}{:02},{:02}{}{:02}{}{:02}.{:03}", s.year, s.month, s.day,
                                                        s.hour, sign, s.minute, sign, s.second, s.ms);
                                   }),
                       sign);
  }
}

}  // namespace
}  // namespace twindeck::records
