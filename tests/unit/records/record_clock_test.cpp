// Oracle: stamps made here from a known rate, with the gaps, repeats and lateness that went into them.
#include "records/record_clock.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace twindeck::records {
namespace {

using Stamp = std::function<double(int)>;

StampedRows stamped(int rows, const Stamp& stamp) {
  StampedRows stamps;
  for (int i = 0; i < rows; ++i) stamps.add(stamp(i));
  return stamps;
}

/// Uniform in [0, 1).
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double operator()() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }

 private:
  std::mt19937_64 random_;
};

void expect_rate(const RecordClock& clock, double rate_Hz, const char* what) {
  EXPECT_LE(std::abs(clock.rate_Hz - rate_Hz), std::max(3.0 * clock.deviation_Hz, 1e-6 * rate_Hz))
      << what << " " << clock.rate_Hz;
  EXPECT_TRUE(clock.gaps.empty()) << what;
  EXPECT_LT(clock.steps_back, 0) << what;
  EXPECT_LT(clock.changes_rate, 0) << what;
}

double floored(double value, double digits) { return std::floor(value / digits) * digits; }

TEST(RecordClock, EvenStampsWhateverTheirDigitsAndUnit) {
  for (const double digits : {1.0, 0.01, 0.001, 1e-6}) {
    for (const double rate : {60.0, 100.8, 128.0, 1000.0}) {
      const RecordClock clock = stamped(6000, [&](int i) { return floored((i + 37.4) / rate, digits); }).clock(1.0);
      expect_rate(clock, rate, "digits");
      EXPECT_LE(clock.deviation_Hz, 2e-3 * rate) << digits << " " << rate;  // six seconds are there: a sample of place each
    }
  }
  const double epoch = 1.7e9;
  expect_rate(stamped(2500, [&](int i) { return 1e3 * epoch + 10.0 * i; }).clock(0.0), 100.0, "ms");
  expect_rate(stamped(2500, [&](int i) { return 1e6 * epoch + 1e4 * i; }).clock(0.0), 100.0, "us");
  expect_rate(stamped(2500, [&](int i) { return 1e9 * epoch + 1e7 * i; }).clock(0.0), 100.0, "ns");
  expect_rate(stamped(2500, [](int i) { return 1e4 * i; }).clock(0.0), 100.0, "us since the start");
  expect_rate(stamped(2500, [](int i) { return 45429.41 + i * 0.01 / 86400.0; }).clock(0.0), 100.0, "days");
  for (const double start : {6.385e17, 1.338e17})
    expect_rate(stamped(2500, [&](int i) { return start + 1e5 * i; }).clock(0.0), 100.0, "ticks of 100 ns");
}

TEST(RecordClock, TwoCoarseStampsSayNoRate) {
  EXPECT_EQ(stamped(3000, [](int i) { return i < 1000 ? 0.0 : 60.0; }).clock(1.0).rate_Hz, 0.0);
  expect_rate(stamped(3000, [](int i) { return std::floor((i + 60) / 1000.0); }).clock(1.0), 1000.0, "one whole second");
}

TEST(RecordClock, LateStampsAndPacketsGiveTheRateWithinItsDeviation) {
  // Three deviations hold 99.7 % of a normal estimate; 95 % are asked, since deviations are estimated from 56 packets.
  Draw draw(53);
  int within = 0, with_gap = 0, runs = 0;
  double packet = 0.0;
  const std::vector<Stamp> kinds = {
      [&](int i) { return floored(i / 100.8 + 0.004 * draw(), 0.001); },
      [&](int i) { return i / 100.8 - 0.002 * std::log(1.0 - draw()); },
      [&](int i) { return packet = i % 25 == 0 ? floored(i / 100.8 + 0.04 * draw(), 0.001) : packet; },
      [&](int i) { return packet = i % 3 == 0 ? i / 100.8 + 0.01 * draw() : packet; }};
  for (const Stamp& kind : kinds) {
    for (int seed = 0; seed < 25; ++seed, ++runs) {
      const RecordClock clock = stamped(1400, kind).clock(1.0);
      within += std::abs(clock.rate_Hz - 100.8) <= 3.0 * clock.deviation_Hz ? 1 : 0;
      with_gap += clock.gaps.empty() ? 0 : 1;
      EXPECT_LT(clock.deviation_Hz, 0.1);  // 0.8 Hz, the error of a nominal 100 Hz, is seen in fourteen seconds
    }
  }
  EXPECT_GE(within, runs * 95 / 100);
  EXPECT_LE(with_gap, runs / 50);
}

TEST(RecordClock, GapsAreFoundWithPlaceAndLength) {
  const auto whole = [](double seconds) { return floored(seconds, 1.0); };
  struct Made {
    const char* what;
    int row, samples;
    Stamp stamp;  // of the sample that stands in a row
  };
  Draw draw(4);
  double packet = 0.0;
  const std::vector<Made> made = {
      {"exact", 40, 5, [](int k) { return k / 100.0; }},
      {"digits", 1500, 1, [](int k) { return floored(k / 128.0, 0.001); }},
      {"late", 1500, 3, [&](int k) { return k / 100.8 + 0.004 * draw(); }},
      {"whole seconds", 1000, 500, [&](int k) { return whole(k / 100.0); }},
      {"within a second", 1040, 560, [&](int k) { return whole(k / 100.0); }},
      {"packets", 1500, 250, [&](int k) { return packet = k % 25 == 0 ? k / 100.8 + 0.04 * draw() : packet; }}};
  for (const Made& m : made) {
    const RecordClock clock = stamped(3000, [&](int i) { return m.stamp(i < m.row ? i : i + m.samples); }).clock(1.0);
    ASSERT_EQ(clock.gaps.size(), 1U) << m.what;
    EXPECT_EQ(clock.gaps[0].row, m.row) << m.what;
    // Packets come up to four samples late: the length of a gap between them is known to about one.
    EXPECT_LE(std::abs(clock.gaps[0].samples - m.samples), std::string(m.what) == "packets" ? 1 : 0) << m.what;
  }
  // One sample in five lost at random, exact stamps: all of them, and none else.
  int at = 0, lost = 0;
  const RecordClock clock = stamped(5000, [&](int i) {
                              for (; i > 0 && draw() < 0.2; ++at) ++lost;
                              return at++ / 100.0;
                            }).clock(1.0);
  EXPECT_EQ(clock.missing(), lost);
  EXPECT_NEAR(clock.rate_Hz, 100.0, 1e-6);
}

TEST(RecordClock, RepeatsStepsBackAndReversedTime) {
  const RecordClock row = stamped(2000, [](int i) { return (i <= 1000 ? i : i - 1) * 0.01; }).clock(1.0);
  ASSERT_EQ(row.gaps.size(), 1U);
  EXPECT_EQ(row.gaps[0].row, 1001);  // the second of the two
  EXPECT_EQ(row.gaps[0].samples, -1);
  const RecordClock block = stamped(2000, [](int i) { return (i < 1000 ? i : i - 50) * 0.01; }).clock(1.0);
  ASSERT_EQ(block.gaps.size(), 1U);
  EXPECT_EQ(block.gaps[0].row, 1000);
  EXPECT_EQ(block.gaps[0].samples, -50);
  EXPECT_EQ(stamped(2000, [](int i) { return i * 0.01 + (i == 777 ? 0.5 : 0.0); }).clock(1.0).steps_back, 778);
  EXPECT_TRUE(stamped(2000, [](int i) { return 20.0 - i * 0.01; }).clock(1.0).reversed);
  EXPECT_TRUE(stamped(2000, [](int) { return 5.0; }).clock(1.0).stands_still);
}

TEST(RecordClock, MidnightIsNoStepBack) {
  for (const double unit : {1.0, 1e3, 1e6})
    expect_rate(stamped(2500, [&](int i) { return unit * std::fmod(86390.0 + i / 100.0, 86400.0); }).clock(1.0 / unit), 100.0,
                "midnight");
  EXPECT_EQ(stamped(2500, [](int i) { return std::fmod(36000.0 + i / 100.0, 36010.0); }).clock(1.0).gaps.size(), 1U);
  expect_rate(stamped(2500, [](int i) { return std::fmod(0.9999 + i / 8640000.0, 1.0); }).clock(0.0), 100.0, "shares of a day");
  const RecordClock bursts = stamped(2500, [](int i) { return i % 1000 / 1000.0; }).clock(1.0);  // of one second each
  EXPECT_TRUE(!bursts.gaps.empty() || bursts.steps_back >= 0);
}

TEST(RecordClock, AnHourThatBeginsAgainIsTheEndOfSummerTime) {
  const double night = 1729990790.0;  // s since 1970 of 00:59:50 on a clock that counts days: any full hour
  for (const double unit : {1.0, 1e3, 1e6, 1.0 / 86400.0}) {
    const RecordClock clock = stamped(3000, [&](int i) {
                                const double t = night + i / 100.0;
                                return unit * (i < 1000 ? t : t - 3600.0);
                              }).clock(1.0 / unit);
    EXPECT_NEAR(clock.rate_Hz, 100.0, 1e-3) << unit;
    EXPECT_TRUE(clock.gaps.empty()) << unit;
    EXPECT_EQ(clock.hour_again, 1000) << unit;
  }
  // Away from a full hour the clock was set, and what was lost is not known.
  const RecordClock set =
      stamped(3000, [&](int i) { return night - 600.0 + i / 100.0 - (i < 1000 ? 0.0 : 3600.0); }).clock(1.0);
  EXPECT_EQ(set.hour_again, -1);
  EXPECT_FALSE(set.gaps.empty());
}

TEST(RecordClock, AGpsWeekBeginsAnew) {
  for (const double unit : {1.0, 1e3})
    expect_rate(stamped(2500, [&](int i) { return unit * std::fmod(604790.0 + i / 100.0, 604800.0); }).clock(1.0 / unit), 100.0,
                "week");
}

TEST(RecordClock, AFullCounterOf32BitsBeginsAnew) {
  for (const double ticks : {1e3, 1e6})
    expect_rate(stamped(2500, [&](int i) { return std::fmod(4294967296.0 - 5.0 * ticks + i * ticks / 100.0, 4294967296.0); })
                    .clock(1.0 / ticks),
                100.0, "ticks");
}

TEST(RecordClock, TimesOfDayAsOneNumber) {
  for (const double unit : {1.0, 1e3}) {  // hhmmss, hhmmssfff
    for (const int first : {86390, 35995, 36054, 36059}) {
      for (const int rows : {1, 100}) {  // to a second
        const auto digits = [&](int i) {
          const int s = (first + i / 100) % 86400;
          return unit * (s / 3600 * 10000 + s / 60 % 60 * 100 + s % 60 + (rows > 1 ? 0.0 : i % 100 / 100.0));
        };
        expect_rate(stamped(15000, digits).clock(1.0 / unit), 100.0, fmt::format("hhmmss from {}, {}", first, rows).c_str());
      }
    }
  }
  // A clock in seconds that stood for 40 s, and one in ms whose step is 41.
  EXPECT_EQ(stamped(2500, [](int i) { return 90.0 + i / 100.0 + (i < 950 ? 0.0 : 40.0); }).clock(1.0).missing(), 4000);
  expect_rate(stamped(2500, [](int i) { return 18.0 + 41.0 * i; }).clock(1e-3), 1e3 / 41.0, "ms");
}

TEST(RecordClock, AnotherRateIsToldFromGaps) {
  for (const double second : {0.005, 0.02, 0.03}) {
    for (const int at : {1000, 1600}) {
      const RecordClock clock =
          stamped(2000, [&](int i) { return i < at ? i * 0.01 : at * 0.01 + (i - at) * second; }).clock(1.0);
      EXPECT_NEAR(static_cast<double>(clock.changes_rate), at, 2.0) << second;
    }
  }
}

TEST(RecordClock, PacketsUnderWholeSecondsAreNoGaps) {
  // A second has 100 or 125 rows (100 or 110, 100 or 150): a packet more now and then. Five lost seconds stay a gap.
  Draw draw(8);
  for (const int packet : {10, 25, 50}) {
    for (const int lost : {0, 500}) {
      const auto arrival = [&](int k) { return (k / packet + 1) * packet / 100.8; };
      std::vector<double> late(3000);
      for (double& value : late) value = 0.02 * draw();
      const RecordClock clock = stamped(20000, [&](int i) {
                                  const int k = i < 8000 ? i : i + lost;
                                  return floored(0.37 + arrival(k) + late[static_cast<std::size_t>(k / packet)], 1.0);
                                }).clock(1.0);
      EXPECT_LE(std::abs(clock.rate_Hz - 100.8), std::max(4.0 * clock.deviation_Hz, packet / 100.0))
          << packet << " " << clock.rate_Hz;
      EXPECT_EQ(clock.gaps.empty(), lost == 0) << packet;
      EXPECT_NEAR(static_cast<double>(clock.missing()), lost, 1.5 * packet);
      EXPECT_LT(std::max(clock.steps_back, clock.changes_rate), 0) << packet;
    }
  }
}

TEST(RecordClock, LostPacketsUnderWholeSecondsDoNotSlowTheRate) {
  // One packet in a hundred is lost, which a line through all stamps takes for a rate 1 % lower.
  Draw draw(31);
  int within = 0, runs = 0;
  for (const int packet : {1, 10, 25, 50}) {
    for (int seed = 0; seed < 10; ++seed, ++runs) {
      StampedRows stamps;
      int lost = 0;
      const double begin = draw();
      for (int k = 0; k * packet < 180000; ++k) {
        const bool there = k == 0 || draw() >= 0.01;
        for (int i = 0; i < packet && there; ++i) stamps.add(std::floor(begin + k * packet / 100.0));
        lost += there ? 0 : packet;
      }
      const RecordClock clock = stamps.clock(1.0);
      within += std::abs(clock.rate_Hz - 100.0) <= 3.0 * clock.deviation_Hz ? 1 : 0;
      EXPECT_NEAR(clock.rate_Hz, 100.0, 0.5) << packet;
      EXPECT_GT(clock.missing(), lost / 2) << packet;
    }
  }
  EXPECT_GE(within, runs * 9 / 10);  // none were before
}

TEST(RecordClock, ADateThatStandsStillAtMidnight) {
  const double midnight = 19860.0 * 86400.0;
  const auto stood = [&](int i, int rows) { return midnight - 5.0 + i / 100.0 - (i < 500 || i >= rows ? 0.0 : 86400.0); };
  for (const int rows : {2500, 503})
    expect_rate(stamped(2500, [&](int i) { return stood(i, rows); }).clock(1.0), 100.0, "date");
}

TEST(RecordClock, WhatRunsLikeTime) {
  using Straight = StampedRows::Straight;
  Draw draw(9);
  const auto like = [](const Stamp& stamp, Straight straight, int rows = 200) {
    return stamped(rows, stamp).runs_like_time(straight);
  };
  for (const Straight straight : {Straight::to_a_sample, Straight::to_a_stamp, Straight::roughly, Straight::named}) {
    EXPECT_TRUE(like([](int i) { return 0.01 * i; }, straight));
    EXPECT_TRUE(like([&](int i) { return 1.7e12 + 10.0 * i + 4.0 * draw(); }, straight));
    EXPECT_FALSE(like([](int i) { return i + 1.0; }, straight));  // counts
    EXPECT_FALSE(like([&](int) { return draw(); }, straight));
    EXPECT_FALSE(like([](int i) { return std::sin(0.1 * i); }, straight));
    EXPECT_FALSE(like([](int i) { return i < 150 ? 1e-3 * i : std::pow(i, 4); }, straight));
  }
  // A broken clock: a lost stamp, a step back, a restart, another rate, stamps out of order by 15 ms.
  const double none = std::nan("");
  EXPECT_TRUE(like([&](int i) { return i == 77 ? none : 0.01 * i; }, Straight::to_a_sample));
  EXPECT_TRUE(like([](int i) { return 0.01 * i - (i < 600 ? 0.0 : 2.0); }, Straight::to_a_sample, 1000));
  EXPECT_TRUE(like([](int i) { return 0.01 * (i % 500); }, Straight::to_a_sample, 1000));
  EXPECT_TRUE(like([](int i) { return i < 400 ? 0.01 * i : 4.0 + 0.02 * (i - 400); }, Straight::to_a_sample, 1000));
  EXPECT_TRUE(like([&](int i) { return 0.01 * i + 0.015 * draw(); }, Straight::to_a_sample, 1000));
  // Late by ten samples, and a clock set back at each packet: only where the name says time.
  EXPECT_EQ(like([&](int i) { return 0.01 * i + 0.1 * draw(); }, Straight::roughly, 1000), false);
  EXPECT_TRUE(like([&](int i) { return 0.01 * i + 0.1 * draw(); }, Straight::named, 1000));
  EXPECT_TRUE(like([](int i) { return 0.011 * i - 0.025 * (i / 25); }, Straight::named, 1000));
  // Packets in milliseconds against a temperature that rises by its last digit.
  double packet = 0.0;
  const auto packets = [&](int i) { return packet = i % 25 == 0 ? floored(10.0 * i + 40.0 * draw(), 1.0) : packet; };
  EXPECT_TRUE(like(packets, Straight::to_a_stamp, 2000));
  EXPECT_FALSE(like(packets, Straight::to_a_sample, 2000));
  const auto warming = [](int i) { return std::round(1e4 * (12.0 + 0.5 * (1.0 - std::exp(-i / 3e4)))) / 1e4; };
  EXPECT_FALSE(like(warming, Straight::to_a_stamp, 2000));
}

}  // namespace
}  // namespace twindeck::records
