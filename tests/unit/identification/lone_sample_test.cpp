// Oracles: samples put into noise by hand; records of what does move a structure: blows, free decays, an earthquake.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "../signal/noise.hpp"
#include "identification/quality.hpp"

namespace twindeck::identification {
namespace {

constexpr int kCount = 5000;

Eigen::VectorXd floor_noise(double mean = 0.0) {
  signal::test::Noise next(3);
  Eigen::VectorXd x(kCount);
  for (double& value : x) value = mean + next();
  return x;
}

/// 2 pi f of a mode in samples: rings, decays.
double ringing(int since, double per_period, double damping) {
  const double omega = 2.0 * std::numbers::pi / per_period;
  return since < 0 ? 0.0 : std::exp(-damping * omega * since) * std::sin(omega * (since + 0.5));
}

// Deviations of unit noise: (value - median)/1, within some per cent in 5000 samples.
TEST(LoneSampleOf, AnErrorValueIsFoundWhereverItStands) {
  for (const double value : {-9999.0, 32767.0, 60.0, 1e30}) {
    for (const int t : {0, 1, 2499, kCount - 2, kCount - 1}) {
      Eigen::VectorXd x = floor_noise(4.0);
      x[t] = value;
      const auto found = lone_sample(x);
      ASSERT_TRUE(found.has_value()) << value << " " << t;
      EXPECT_EQ(found->sample, t);
      EXPECT_EQ(found->value, value);
      EXPECT_NEAR(found->deviations / std::abs(value - 4.0), 1.0, 0.05);
    }
  }
}

TEST(LoneSampleOf, UpToThreeInARowHeldAndSeveralNearOneAnother) {
  Eigen::VectorXd x = floor_noise();
  x.segment(1000, 3).setConstant(-9999.0);
  x[1005] = -9999.0;
  EXPECT_EQ(lone_sample(x)->value, -9999.0);
  x.segment(1000, 9).setConstant(-9999.0);  // an error value that is held
  ASSERT_TRUE(lone_sample(x).has_value());
  EXPECT_EQ(lone_sample(x)->samples, 9);
  for (int k = 0; k < 9; ++k) x[1000 + k] = -9999.0 + k;  // a motion
  EXPECT_FALSE(lone_sample(x).has_value());
}

// Of a long record the median is that of samples drawn from it. Median
// distance of a sine of amplitude a: a/sqrt(2).
TEST(LoneSampleOf, ALongRecordIsReadAsAShortOne) {
  Eigen::VectorXd x(400000);
  for (Eigen::Index t = 0; t < x.size(); ++t) x[t] = 3.0 * std::sin(2.0 * std::numbers::pi * static_cast<double>(t) / 7.3);
  EXPECT_FALSE(lone_sample(x).has_value());
  x[123456] = 1000.0;
  const auto found = lone_sample(x);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->sample, 123456);
  EXPECT_NEAR(found->deviations / (1000.0 / (1.4826 * 3.0 / std::numbers::sqrt2)), 1.0, 0.02);
}

TEST(LoneSampleOf, NoiseHasNone) { EXPECT_FALSE(lone_sample(floor_noise()).has_value()); }

TEST(LoneSampleOf, MissingNeighboursAreLeftOut) {
  Eigen::VectorXd x = floor_noise();
  x[200] = 500.0;
  x[199] = x[201] = std::numeric_limits<double>::quiet_NaN();
  x[300] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(lone_sample(x)->sample, 200);
}

// More than half of the samples are the same count: the next count is the unit.
TEST(LoneSampleOf, AQuietRecordInCounts) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(kCount);
  for (int t = 0; t < kCount; t += 7) x[t] = 0.5;
  EXPECT_FALSE(lone_sample(x).has_value());
  x[401] = 100.0;
  EXPECT_EQ(lone_sample(x)->deviations, 200.0);
}

// A blow of 1000 deviations rings: fast modes with 2 and 5 % of damping, from 2.2 samples a period on.
TEST(LoneSampleOf, ABlowIsFollowedByItsDecay) {
  for (const double per_period : {2.2, 3.0, 7.0, 50.0}) {
    for (const double damping : {0.005, 0.02, 0.05}) {
      Eigen::VectorXd x = floor_noise();
      for (int t = 0; t < kCount; ++t) x[t] += 1000.0 * ringing(t - 2000, per_period, damping);
      EXPECT_FALSE(lone_sample(x).has_value()) << per_period << " " << damping;
    }
  }
}

// A pulse without a decay, through a filter that ends at 0.8 of the Nyquist frequency: sin(0.8 pi t)/(0.8 pi t), at any phase.
TEST(LoneSampleOf, AFilteredPulseReachesItsNeighbours) {
  for (const double phase : {0.0, 0.1, 0.25, 0.5}) {
    Eigen::VectorXd x = floor_noise();
    for (int t = 0; t < kCount; ++t) {
      const double at = 0.8 * std::numbers::pi * (t - 2000 + phase);
      x[t] += 1000.0 * (at == 0.0 ? 1.0 : std::sin(at) / at);
    }
    EXPECT_FALSE(lone_sample(x).has_value()) << phase;
  }
}

// Ten seconds of strong noise amid the quiet, and a pull that is released.
TEST(LoneSampleOf, AnEarthquakeAndAReleaseLast) {
  Eigen::VectorXd quake = floor_noise(), release = floor_noise();
  for (int t = 2000; t < 3000; ++t) quake[t] *= 2000.0;
  for (int t = 0; t < kCount; ++t) release[t] += t < 1000 ? 500.0 : 500.0 * ringing(t - 1000, 20.0, 0.01);
  EXPECT_FALSE(lone_sample(quake).has_value());
  EXPECT_FALSE(lone_sample(release).has_value());
}

}  // namespace
}  // namespace twindeck::identification
