// Oracle: files written here with lines that do not belong, and the rows that do; sizes of lines at which the earlier reader,
// which asked regular expressions, overflowed the stack.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "records/header_rate.hpp"
#include "records/inspect.hpp"
#include "records/text_cells.hpp"
#include "records/time_stamp.hpp"
#include "refusal.hpp"
#include "scratch.hpp"

namespace twindeck::records {
namespace {

/// 200 rows of three channels, with `stray` before row `at`.
std::string table(int at, const std::string& stray, bool time = true) {
  std::string text = time ? "time_s,D_z,A_x,B_x\n" : "D_z,A_x,B_x\n";
  for (int t = 0; t < 200; ++t) {
    if (t == at) text += stray;
    text += (time ? fmt::format("{:.2f},", 0.01 * t) : std::string()) + fmt::format("{},{},{}\n", t + 0.25, t + 0.5, t + 0.75);
  }
  return text;
}

TEST(StrayLines, AreRefusedWithTheirNumberAndHideNoHeader) {
  const Scratch scratch;
  for (const int at : {0, 1, 2, 3, 50, 60, 199}) {
    for (const char* stray : {"logger restarted\n", "0.6,1,2\n", "0.6,1,2,3,4\n", "a,b,c,d\n", "Max,3.5,2.5,1.5\n",
                              "# event 7\n", "\x1b[2J\n", "0.6,1,oops,3\n", "0.6,1,1e999,3\n"}) {
      const std::string said = refusal(scratch.write("a.csv", table(at, stray)));
      if (at ==
          0) {  // between header and rows it is one more line of the header; then the names are not the line above the rows
        continue;
      }
      EXPECT_NE(said.find(fmt::format("a.csv:{}: '", at + 2)), std::string::npos) << at << " " << stray << said;
      EXPECT_NE(said.find("skip_stray_lines = true"), std::string::npos) << said;
      EXPECT_EQ(said.find('\x1b'), std::string::npos);
    }
  }
}

TEST(StrayLines, AreSkippedAndCountedWhereTheUserSaysSo) {
  const Scratch scratch;
  for (const bool time : {false, true}) {
    for (const int at : {1, 2, 57}) {
      const Record record = read(scratch.write("a.csv", table(at, "logger restarted\n0.6,1\n", time)), ReadOptions{true});
      ASSERT_EQ(record.samples.rows(), 200);
      EXPECT_EQ(record.info.channels[0].name, "D_z");
      for (int t = 0; t < 200; ++t) EXPECT_EQ(record.samples(t, 1), t + 0.5);
      ASSERT_EQ(record.info.notes.size(), 1U);
      EXPECT_EQ(record.info.notes[0],
                fmt::format("2 lines are no rows of the table and are left out, the first is line {}", at + 2));
    }
  }
  // Where a sample is lost with its line, the time stamps show it: missing, not shifted.
  std::string text = table(-1, "");
  text.replace(text.find("0.57,"), 4, "oops");
  const Record record = read(scratch.write("a.csv", text), ReadOptions{true});
  ASSERT_EQ(record.samples.rows(), 200);
  EXPECT_TRUE(std::isnan(record.samples(57, 0)));
  EXPECT_EQ(record.samples(58, 0), 58.25);
  // Whoever asks what the file holds is told.
  const Inspection inspection = inspect(scratch.file("a.csv"));
  EXPECT_EQ(inspection.channels[0].missing, 1);
}

TEST(StrayLines, WhatIsNone) {
  const Scratch scratch;
  // Empty lines, a last cell that is missing, trailing separators, words for missing values at the beginning.
  std::string text = "t;a;b\n\n";
  for (int t = 0; t < 100; ++t) {
    if (t == 60) text += "\n";
    text += fmt::format("{:.2f};{};{}\n", 0.01 * t, t < 2 ? "NaN" : std::to_string(t),
                        t == 0 || t == 70 ? "" : std::to_string(2 * t) + (t == 80 ? ";;" : ""));
  }
  const Record record = read(scratch.write("a.csv", text));
  ASSERT_EQ(record.samples.rows(), 100);
  EXPECT_EQ(record.info.channels[1].name, "b");
  EXPECT_TRUE(std::isnan(record.samples(0, 0)) && std::isnan(record.samples(0, 1)) && std::isnan(record.samples(70, 1)));
  EXPECT_EQ(record.samples(99, 1), 198.0);
  EXPECT_EQ(record.samples(80, 1), 160.0);
  EXPECT_TRUE(record.info.notes.empty());
  // Rows of numbers in a header, fewer than three, are no data.
  std::string header = "Sensors 12 of 2026\n101;102;103\n0.5;0.5;0.5\nx;y;z\n";
  for (int t = 0; t < 50; ++t) header += fmt::format("{};{};{}\n", 10 * t, t, -t);
  const Record plain = read(scratch.write("b.csv", header));
  EXPECT_EQ(plain.samples.rows(), 50);
}

TEST(StrayLines, AMarkOfUtf8BeforeTheFirstNumberIsNoPartOfIt) {
  const Scratch scratch;
  EXPECT_EQ(read(scratch.write("a.csv",
                               "\xEF\xBB\xBF"
                               "7,2\n8,4\n9,7\n"))
                .samples(0, 0),
            7.0);
}

// Each was a stack overflow or hours of work of std::regex.
TEST(LongLines, OfAHeaderEndInAMessageOrAreRead) {
  const Scratch scratch;
  std::string rows;
  for (int t = 0; t < 20; ++t) rows += fmt::format("{:.2f},{}\n", 0.01 * t, 3 * t);
  for (const std::string& filling : {std::string(200000, ' '), std::string(200000, 'x'), std::string(200000, '['),
                                     std::string(200000, 'M'), std::string(200000, '1'), std::string(200000, 's')}) {
    for (const char* before : {"sampling", "time_s,a", "sampling rate: ", "dt [", "time_s,a (", "\"", "t"}) {
      const auto file = scratch.write("a.csv", before + filling + "\n" + rows);
      try {
        EXPECT_EQ(read(file).samples.rows(), 20) << before << filling[0];
      } catch (const InputError& error) {
        EXPECT_LT(std::string(error.what()).size(), 4000U);
      }
    }
  }
  std::string wide = "a";
  for (int c = 1; c < 100000; ++c) wide += ",a";
  std::string row = "1";
  for (int c = 1; c < 100000; ++c) row += ",1";
  EXPECT_EQ(read(scratch.write("wide.csv", wide + "\n" + row + "\n" + row + "\n")).samples.cols(), 100000);
}

TEST(LongGaps, AClockThatJumpsFarIsRefusedWithTheLine) {
  const Scratch scratch;
  std::string text = "time_s,a\n";
  for (int t = 0; t < 50; ++t) text += fmt::format("{:.2f},1.5\n", 0.01 * t + (t >= 30 ? 1e9 : 0.0));
  EXPECT_NE(refusal(scratch.write("a.csv", text))
                .find("a.csv:32: sample 30 comes 1e+09 s after the row before it, a gap of 1e+11 samples"),
            std::string::npos);
}

TEST(HeaderRate, LinesOfLoggers) {
  const auto rate = [](const char* line) { return rate_in_header_line(line).value_or(0.0); };
  EXPECT_DOUBLE_EQ(rate("SamplingPeriod_us=10000"), 100.0);
  EXPECT_DOUBLE_EQ(rate("dt_ms = 10"), 100.0);
  EXPECT_DOUBLE_EQ(rate("sampling_rate_khz: 0.1"), 100.0);
  EXPECT_NEAR(rate("Sampling rate;200,5;Hz"), 200.5, 1e-12);
  EXPECT_NEAR(rate("# fs = 100"), 100.0, 1e-12);
  EXPECT_NEAR(rate("# dt = 5 ms"), 200.0, 1e-12);
  EXPECT_NEAR(rate("dt [ms] 5"), 200.0, 1e-12);
  EXPECT_NEAR(rate("Abtastrate: 0,25 kHz"), 250.0, 1e-12);
  EXPECT_NEAR(rate("\"sampling_frequency (Hz)\",\"128\""), 128.0, 1e-12);
  EXPECT_NEAR(rate("sampling interval = 5e-3 s"), 200.0, 1e-12);
  EXPECT_NEAR(rate("Time step: 10 ms"), 100.0, 1e-12);
  EXPECT_NEAR(rate("frequenza di campionamento = 64"), 64.0, 1e-12);
  EXPECT_NEAR(rate("Messrate: 100,0 Hz"), 100.0, 1e-12);
  EXPECT_NEAR(rate("Scan rate, 50"), 50.0, 1e-12);
  EXPECT_NEAR(rate("Samples per channel: 12000"), 0.0, 0.0);
  EXPECT_NEAR(rate("Samples: 12000"), 0.0, 0.0);  // their number
  EXPECT_NEAR(rate("offset 12"), 0.0, 0.0);       // "fs" and "dt" stand for themselves only
  EXPECT_NEAR(rate("fs"), 0.0, 0.0);
}

TEST(TimeName, IsAWordOfTheName) {
  for (const char* name : {"time", "Time_s", "t", "T [s]", "Zeit", "time stamp", "elapsed (s)", "tms", "rel. time", "Date",
                           "Data/Ora", "sec", "x_time", "sensorTimestamp_since1970(s)", "Zeitstempel"}) {
    EXPECT_TRUE(is_time_name(name)) << name;
  }
  for (const char* name : {"A_x", "top", "TR1", "T09y", "T1", "strain", "east", "overtime"})
    EXPECT_FALSE(is_time_name(name)) << name;
}

TEST(Cells, DatesAndNumbers) {
  EXPECT_TRUE(is_date("03.04.2021") && is_date("2021-4-3") && is_date("3/4/21"));
  EXPECT_FALSE(is_date("3.4") || is_date("3.4.20211") || is_date("3.4.2021x") || is_date("") || is_date("20211.1.1"));
  EXPECT_EQ(number_in("1,5", true), 1.5);
  EXPECT_EQ(number_in("+2.5D-1", false), 0.25);
  EXPECT_EQ(number_in("\u22121.5e\u22123", false), -1.5e-3);
  EXPECT_FALSE(number_in("1.2.3", false).has_value());
}

}  // namespace
}  // namespace twindeck::records
