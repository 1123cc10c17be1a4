// Oracle: tables and matrices made here whose clock is broken, named otherwise, or that of other rows.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "npy_double.hpp"
#include "records/record.hpp"
#include "records/take_clock.hpp"
#include "refusal.hpp"
#include "scratch.hpp"

namespace twindeck::records {
namespace {

double swing(int t, int c) { return std::round(1e4 * std::sin(0.41 * t * (c + 1) + c)) / 1e4; }

/// A table with stamps in the first column and two channels beside.
std::string stamped_table(const std::string& header, int rows, const std::function<std::string(int)>& stamp) {
  std::string text = header.empty() ? "" : header + ",P1,P2\n";
  for (int t = 0; t < rows; ++t) text += fmt::format("{},{:.4f},{:.4f}\n", stamp(t), swing(t, 0), swing(t, 1));
  return text;
}

/// [s] Up to 15 ms late, in no order.
double late_s(int t) { return 0.01 * t + 0.015 * static_cast<double>(std::mt19937(static_cast<unsigned>(t))()) / 4294967296.0; }

/// Milliseconds of packets of 25 rows at 100 Hz that come up to 40 ms late.
std::string packet_ms(int t) {
  const int packet = t / 25;
  return fmt::format("{}", 1700000000000LL + 250LL * packet + static_cast<long long>(20.0 + 20.0 * std::sin(7.3 * packet)));
}

TEST(BrokenClock, OfAMatrixIsNoChannel) {
  const Scratch scratch;
  struct Broken {
    const char* what;
    std::function<double(int)> stamp;
    bool refused;  // by its clock; the rate of the others is right
  };
  const std::vector<Broken> all = {{"lost stamp", [](int t) { return t == 77 ? std::nan("") : 0.01 * t; }, false},
                                   {"back 2 s", [](int t) { return 0.01 * t - (t < 1000 ? 0.0 : 2.0); }, true},
                                   {"restart", [](int t) { return 0.01 * (t % 1000); }, true},
                                   {"two rates", [](int t) { return t < 1000 ? 0.01 * t : 10.0 + 0.02 * (t - 1000); }, true},
                                   {"out of order", late_s, false}};
  for (const Broken& broken : all) {
    Eigen::MatrixXd matrix(2000, 3);
    for (int t = 0; t < 2000; ++t) matrix.row(t) << broken.stamp(t), swing(t, 0), swing(t, 1);
    io::write_npy(matrix, scratch.file("a.npy"));
    RecordInfo info = scan(scratch.file("a.npy"), [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {});
    ASSERT_EQ(info.channels.size(), 2U) << broken.what;
    const bool doubtful = info.clock.changes_rate >= 0 || info.clock.steps_back >= 0 || info.clock.repeated() > 0;
    EXPECT_EQ(doubtful, broken.refused) << broken.what;
    EXPECT_NEAR(broken.refused ? 100.0 : info.rate_Hz, 100.0, 0.02) << broken.what;
  }
}

TEST(Packets, AreTimeWhateverTheFirstColumnIsCalled) {
  const Scratch scratch;
  for (const char* name : {"", "Clock", "received_ms", "Tijd", "Zeitpunkt", "hora", "Temps (ms)", "tick", "us"}) {
    const Record record = read(scratch.write("a.csv", stamped_table(name, 2500, packet_ms)));
    ASSERT_EQ(record.samples.cols(), 2) << name;
    EXPECT_NEAR(record.info.clock.rate_Hz * (record.info.clock.rate_Hz > 1000.0 ? 1e-3 : 1.0), 100.0, 0.2) << name;
  }
  const auto warming = [](int t) { return fmt::format("{:.4f}", 12.0 + 0.5 * (1.0 - std::exp(-t / 3e4))); };
  for (const char* name : {"Temp", "Temp [degC]", "P0"})
    EXPECT_EQ(read(scratch.write("a.csv", stamped_table(name, 2500, warming))).samples.cols(), 3) << name;
  EXPECT_EQ(read(scratch.write("a.csv", stamped_table("Strain [um/m]", 2500, packet_ms))).samples.cols(), 3);
}

TEST(TimeNames, ALateClockIsFittedOrKeptAsTime) {
  const Scratch scratch;
  const auto late = [](int t) { return fmt::format("{:.3f}", late_s(t)); };
  const Record record = read(scratch.write("a.csv", stamped_table("time", 2500, late)));
  ASSERT_EQ(record.samples.cols(), 2);
  EXPECT_NEAR(record.info.rate_Hz, 100.0, 0.02);
  const auto sawtooth = [](int t) { return fmt::format("{:.3f}", 0.011 * t - 0.025 * (t / 25)); };
  EXPECT_EQ(scan(scratch.write("a.csv", stamped_table("time", 2500, sawtooth)), [](auto, auto, const auto&) {}).channels.size(),
            2U);
}

TEST(TimeNames, OfTheDay) {
  const Scratch scratch;
  for (const char* name : {"Time of day", "seconds of day", "Time_of_day_s", "Time of day (s)"}) {
    const auto stamp = [](int t) { return fmt::format("{:.2f}", 36000.0 + 0.01 * t); };
    EXPECT_NEAR(read(scratch.write("a.csv", stamped_table(name, 500, stamp))).info.rate_Hz, 100.0, 1e-6) << name;
  }
  const auto stamp = [](int t) { return fmt::format("{}", 36000000 + 10 * t); };
  EXPECT_NEAR(read(scratch.write("a.csv", stamped_table("ms of day", 500, stamp))).info.rate_Hz, 100.0, 1e-6);
  EXPECT_EQ(without_time_unit("ms of day").second, 1e-3);
  EXPECT_EQ(without_time_unit("Time of day").second, 0.0);
  EXPECT_EQ(without_time_unit("elapsed (days)").second, 86400.0);
}

TEST(TimesOfDay, OverMidnightUnderADateThatStandsStill) {
  const Scratch scratch;
  const auto clock_at = [](int hundredths) {
    const int s = hundredths / 100;
    return fmt::format("{:02d}:{:02d}:{:02d}.{:02d}", s / 3600, s / 60 % 60, s % 60, hundredths % 100);
  };
  const auto stuck = [&](int t) { return "2024-05-17 " + clock_at((8639000 + t) % 8640000); };
  const auto elapsed = [&](int t) { return clock_at(35999000 + t); };  // from 99:59:50.00 on
  for (const std::function<std::string(int)>& stamp : {std::function<std::string(int)>(stuck), {elapsed}}) {
    const Record record = read(scratch.write("a.csv", stamped_table("time", 2500, stamp)));
    EXPECT_EQ(record.samples.rows(), 2500) << stamp(0);
    EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-6) << stamp(0);
  }
}

TEST(Width, RowsThatLackTheirLastCells) {
  const Scratch scratch;
  struct Tail {
    const char* what;
    std::function<std::string(int)> text;
  };
  const std::vector<Tail> tails = {
      {"one full row, far down", [](int t) { return t == 3000 ? ",12.5" : ""; }},
      {"separators come and go", [](int t) { return t % 100 == 0      ? ",12.5"
                                                    : t / 16 % 2 == 0 ? ","
                                                                      : ""; }},
      {"separators end far down", [](int t) { return t % 100 == 0 ? ",12.5"
                                                     : t < 2500   ? ","
                                                                  : ""; }},
      {"mostly there", [](int t) { return t % 500 == 0 ? "" : ",12.5"; }}};
  for (const Tail& tail : tails) {
    std::string text = "time,P1,P2,Temp\n";
    for (int t = 0; t < 4000; ++t)
      text += fmt::format("{:.2f},{:.4f},{:.4f}{}\n", 0.01 * t, swing(t, 0), swing(t, 1), tail.text(t));
    const Record record = read(scratch.write("a.csv", text));
    ASSERT_EQ(record.samples.rows(), 4000) << tail.what;
    ASSERT_EQ(record.samples.cols(), 3) << tail.what;
    EXPECT_EQ(record.info.channels[2].name, "Temp") << tail.what;
    for (int t = 0; t < 4000; ++t) ASSERT_EQ(record.samples(t, 1), swing(t, 1)) << tail.what << t;
  }
  // One row that lacks a cell of a column that is full elsewhere is damage.
  std::string text = "time,P1,P2\n";
  for (int t = 0; t < 400; ++t)
    text += fmt::format("{:.2f},{:.4f}{}\n", 0.01 * t, swing(t, 0), t == 200 ? "" : fmt::format(",{:.4f}", swing(t, 1)));
  EXPECT_NE(refusal(scratch.write("a.csv", text)).find("a.csv:202: "), std::string::npos);
}

TEST(RowsOfTheirOwn, TheClockIsThatOfTheRowsAskedFor) {
  const Scratch scratch;
  std::string text = "time,P1,P2,Temp\n";
  for (int t = 0; t < 3000; ++t) {
    text += fmt::format("{:.3f},{:.4f},{:.4f},\n", 0.01 * t, swing(t, 0), swing(t, 1));
    if (t % 100 == 37) text += fmt::format("{:.3f},,,12.5\n", 0.01 * t + 0.004);
  }
  const auto file = scratch.write("a.csv", text);
  EXPECT_TRUE(read(file).info.apart);
  const Record record = read(file, {.rows_of = {0, 1}});
  EXPECT_EQ(record.samples.rows(), 3000);
  EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-6);
  EXPECT_TRUE(record.samples.leftCols(2).allFinite());
}

TEST(LongGaps, MoreIsMissingThanThere) {
  const Scratch scratch;
  const auto jumps = [](int by) { return [by](int t) { return fmt::format("{:.2f}", 0.01 * (t < 300 ? t : t + by)); }; };
  EXPECT_NE(refusal(scratch.write("a.csv", stamped_table("time", 600, jumps(601)))).find("more is missing than the 600"),
            std::string::npos);
  EXPECT_EQ(refusal(scratch.write("a.csv", stamped_table("time", 600, jumps(599)))), "");
}

}  // namespace
}  // namespace twindeck::records
