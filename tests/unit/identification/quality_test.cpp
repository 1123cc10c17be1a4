// Oracles: hand counts on short records; a straight line and a sine in closed form; units of a channel.
#include "identification/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace twindeck::identification {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

Eigen::MatrixXd column(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

ChannelQuality quality_of_values(const std::vector<double>& values) {
  return channel_quality(Samples(column(values)), {"a"}, "S1", "r.csv").front();
}

// A slow channel in a faster table, also with two equal values in a row and a lost row; a quiet one in counts changes anywhere.
TEST(ChannelQualityOf, AChannelThatHoldsItsValues) {
  std::vector<double> held, counts;
  for (int k = 0; k < 1200; ++k) {
    const double value = std::sin(0.7 * (k == 40 ? 39 : k));
    if (k != 500) held.insert(held.end(), k == 700 ? 3 : 4, value);
    for (int row = 0; row < 4; ++row) counts.push_back(std::round(0.9 * std::sin(0.21 * (4 * k + row))));
  }
  EXPECT_EQ(quality_of_values(held).held, 4);
  EXPECT_EQ(quality_of_values(held).clipped, 0);  // the largest value stands for four samples as all do
  EXPECT_EQ(quality_of_values(counts).held, 1);
  EXPECT_EQ(quality_of_values(std::vector<double>(100, 1.0)).held, 1);
}

// 0 … n-1 over n samples: mean (n - 1)/2, rms sqrt((n² - 1)/12), drift (n - 1)/rms.
TEST(ChannelQualityOf, AStraightLineInClosedForm) {
  std::vector<double> line;
  for (int t = 0; t < 50; ++t) line.push_back(3.0 * t + 7.0);
  const ChannelQuality q = quality_of_values(line);
  const double rms = 3.0 * std::sqrt((2500.0 - 1.0) / 12.0);
  EXPECT_NEAR(q.mean, 3.0 * 24.5 + 7.0, 1e-12);
  EXPECT_NEAR(q.rms, rms, 1e-12);
  EXPECT_NEAR(q.drift, 3.0 * 49.0 / rms, 1e-12);
  EXPECT_FALSE(q.dead);
  EXPECT_EQ(q.samples, 50);
  EXPECT_EQ(q.missing + q.longest_gap + q.clipped, 0);
}

// A line is the same line where samples are missing; they do not count in mean and rms.
TEST(ChannelQualityOf, MissingSamplesDoNotBendTheLine) {
  const ChannelQuality q = quality_of_values({0.0, 1.0, kMissing, kMissing, kMissing, 5.0, kMissing, 7.0});
  EXPECT_EQ(q.missing, 4);
  EXPECT_EQ(q.longest_gap, 3);
  EXPECT_NEAR(q.mean, 13.0 / 4.0, 1e-14);
  // Squares about 3.25: 10.5625 + 5.0625 + 3.0625 + 14.0625 = 32.75.
  EXPECT_NEAR(q.rms, std::sqrt(32.75 / 4.0), 1e-14);
  EXPECT_NEAR(q.drift, 7.0 / std::sqrt(32.75 / 4.0), 1e-12);
}

// An infinite sample is missing too, and gaps at either end count.
TEST(ChannelQualityOf, GapsAtTheEndsAndInfinitiesCount) {
  const double inf = std::numeric_limits<double>::infinity();
  const ChannelQuality q = quality_of_values({kMissing, inf, 1.0, 2.0, 1.0, -inf, kMissing, kMissing});
  EXPECT_EQ(q.missing, 5);
  EXPECT_EQ(q.longest_gap, 3);
  EXPECT_NEAR(q.mean, 4.0 / 3.0, 1e-15);
}

// A sine of whole periods: rms 1/sqrt(2) of its amplitude. A change of unit scales mean and rms, and leaves the drift.
TEST(ChannelQualityOf, AUnitScalesMeanAndRms) {
  std::vector<double> sine, other;
  for (int t = 0; t < 400; ++t) {
    sine.push_back(2.0 * std::sin(2.0 * std::numbers::pi * t / 40.0) + 5.0);
    other.push_back(-1000.0 * sine.back());
  }
  const ChannelQuality q = quality_of_values(sine), scaled = quality_of_values(other);
  EXPECT_NEAR(q.rms, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(q.mean, 5.0, 1e-12);
  EXPECT_NEAR(scaled.rms, 1000.0 * q.rms, 1e-9);
  EXPECT_NEAR(scaled.mean, -1000.0 * q.mean, 1e-9);
  EXPECT_NEAR(scaled.drift, -q.drift, 1e-12);
}

TEST(ChannelQualityOf, AConstantChannelIsDead) {
  const ChannelQuality q = quality_of_values({4.0, 4.0, kMissing, 4.0});
  EXPECT_TRUE(q.dead);
  EXPECT_EQ(q.mean, 4.0);
  EXPECT_EQ(q.rms, 0.0);
  EXPECT_EQ(q.drift, 0.0);
  EXPECT_EQ(q.clipped, 0);
  EXPECT_TRUE(quality_of_values({4.0}).dead);
}

TEST(ChannelQualityOf, AChannelWithoutSamplesIsDead) {
  const ChannelQuality q = quality_of_values({kMissing, kMissing});
  EXPECT_TRUE(q.dead);
  EXPECT_EQ(q.missing, 2);
  EXPECT_EQ(q.longest_gap, 2);
}

// Runs of three or more at the largest or smallest value: 3 at the top and 4 at the bottom; a run of two and one amid the range
// are none.
TEST(ChannelQualityOf, ClippedSamplesAreRunsAtTheEnds) {
  EXPECT_EQ(quality_of_values({0, 9, 9, 9, 0, 4, 4, 4, 4, 9, 9, 1, -9, -9, -9, -9}).clipped, 7);
  EXPECT_EQ(quality_of_values({9, 9, 9, 0, 1, -9}).clipped, 3);              // from the first sample on
  EXPECT_EQ(quality_of_values({9, 9, 9, -9, -9, -9}).clipped, 6);            // from one end to the other
  EXPECT_EQ(quality_of_values({9, 9, kMissing, 9, 9, 0}).clipped, 0);        // a gap ends a run
  EXPECT_EQ(quality_of_values({9, 9, -9, 9, -9, 9, -9, -9, 0}).clipped, 0);  // the ends in turn
}

TEST(ChannelQualityOf, NamesStandInEachRow) {
  Eigen::MatrixXd data(3, 2);
  data << 1.0, 4.0, 2.0, 5.0, 4.0, 5.0;
  const auto rows = channel_quality(Samples(data), {"a", "b"}, "S2", "r.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].channel, "b");
  EXPECT_EQ(rows[1].setup, "S2");
  EXPECT_EQ(rows[1].record, "r.csv");
  EXPECT_NEAR(rows[1].mean, 14.0 / 3.0, 1e-14);
  EXPECT_FALSE(rows[1].lag_s.has_value());
}

// 1 . . 7 over a gap of two is 1 3 5 7.
TEST(FillGaps, AStraightLineBridgesAGap) {
  Eigen::MatrixXd data(6, 2);
  data << 1.0, 0.0, kMissing, 2.0, kMissing, kMissing, 7.0, 4.0, kMissing, 6.0, 5.0, 8.0;
  EXPECT_EQ(fill_gaps(data, {"a", "b"}, 2, "r.csv"), 4);
  EXPECT_LT((data.col(0) - column({1.0, 3.0, 5.0, 7.0, 6.0, 5.0})).norm(), 1e-15);
  EXPECT_LT((data.col(1) - column({0.0, 2.0, 3.0, 4.0, 6.0, 8.0})).norm(), 1e-15);
  EXPECT_EQ(fill_gaps(data, {"a", "b"}, 0, "r.csv"), 0);
}

// A bridge over more than was measured is no measurement, and none holds at an end; another channel's gap counts too.
TEST(FillGaps, ABridgeIsAdvisedOnlyWhereItHolds) {
  const auto advised = [](const std::vector<double>& a, const std::vector<double>& b) {
    Eigen::MatrixXd data(5, 2);
    data << column(a), column(b);
    try {
      (void)fill_gaps(data, {"a", "b"}, 0, "r.csv");
    } catch (const UnusableRecord& error) {
      return std::string(error.what()).find("longest_gap") != std::string::npos;
    }
    ADD_FAILURE() << "a gap is bridged";
    return false;
  };
  const std::vector<double> whole = {1, 2, 3, 4, 5}, inside = {1, kMissing, 3, 4, 5},
                            mostly = {1, kMissing, kMissing, kMissing, 5}, open = {1, 2, 3, 4, kMissing};
  EXPECT_TRUE(advised(inside, whole));
  EXPECT_FALSE(advised(mostly, whole));
  EXPECT_FALSE(advised(inside, open));
}

TEST(FillGaps, ALongerGapOrOneAtAnEndIsRefusedNamingTheChannel) {
  const std::vector<std::vector<double>> refused = {
      {1.0, kMissing, kMissing, kMissing, 2.0, 1.0, 2.0}, {kMissing, 1.0, 2.0}, {1.0, 2.0, kMissing}, {kMissing}};
  for (const std::vector<double>& values : refused) {
    Eigen::MatrixXd data = column(values);
    try {
      fill_gaps(data, {"mast"}, 2, "r.csv");
      FAIL() << "a gap is bridged";
    } catch (const UnusableRecord& error) {
      EXPECT_NE(std::string(error.what()).find("mast"), std::string::npos) << error.what();
      const bool inside = std::isfinite(values.front()) && std::isfinite(values.back());
      EXPECT_EQ(std::string(error.what()).find("longest_gap=3") != std::string::npos, inside) << error.what();
    }
  }
}

}  // namespace
}  // namespace twindeck::identification
