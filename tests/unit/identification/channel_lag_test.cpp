// Oracles: shapes that are turned by the phases of a chosen lag, exp(-i 2 pi f tau); the propagation of a phase's deviation to
// that of a slope in closed form.
#include "identification/channel_lag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace twindeck::identification {
namespace {

using std::numbers::pi;

/// Three channels; the second lags by `lag_s`. Real shapes of either sign, deviations of 0.001.
identification::Identification lagging(const std::vector<double>& frequencies_Hz, double lag_s) {
  identification::Identification found;
  double sign = 1.0;
  for (const double f : frequencies_Hz) {
    identification::Cluster mode;
    mode.frequency_Hz = f;
    mode.shape = Eigen::Vector3cd(0.6, sign * 0.5, -0.6);
    mode.shape[1] *= std::polar(1.0, -2.0 * pi * f * lag_s);
    mode.shape *= std::polar(1.0, 0.3 * f);  // a phase of the whole shape does not count
    found.modes.push_back(mode);
    identification::ModeDeviation deviation;
    deviation.shape_real = deviation.shape_imag = Eigen::Vector3d::Constant(0.001);
    found.deviations.push_back(deviation);
    sign = -sign;
  }
  return found;
}

Conditioned three_channels() {
  Conditioned conditioned;
  for (const char* name : {"a", "b", "c"}) {
    conditioned.channels.emplace_back().name = name;
    conditioned.quality.emplace_back().channel = name;
  }
  return conditioned;
}

// The line meets the phases exactly: the Gauss-Newton step ends at the lag up to rounding.
TEST(EstimateLags, AChosenLagIsFoundInEitherDirection) {
  for (const double lag : {0.0, 0.004, -0.004, 0.03, -0.03}) {  // a quarter of the highest period is 0.05 s
    Conditioned conditioned = three_channels();
    estimate_lags(conditioned, lagging({0.8, 2.0, 3.1, 5.0}, lag));
    ASSERT_TRUE(conditioned.quality[1].lag_s.has_value());
    EXPECT_NEAR(*conditioned.quality[1].lag_s, lag, 1e-12);
    EXPECT_NEAR(conditioned.quality[0].lag_s.value_or(9.0), 0.0, 0.0);
    EXPECT_NEAR(conditioned.quality[2].lag_s.value_or(9.0), 0.0, 1e-12);
  }
}

// Phases repeat after half a turn: beyond a quarter of the highest period (0.05 s) the other modes tell the lag.
TEST(EstimateLags, ALagOfMoreThanAQuarterPeriodIsFound) {
  for (const double lag : {0.07, -0.07, 0.25}) {
    Conditioned conditioned = three_channels();
    estimate_lags(conditioned, lagging({0.8, 2.0, 3.1, 5.0}, lag));
    EXPECT_NEAR(conditioned.quality[1].lag_s.value_or(9.0), lag, 1e-12);
    EXPECT_NEAR(conditioned.quality[2].lag_s.value_or(9.0), 0.0, 1e-12);
  }
}

// Variance of a phase (0.001/0.5)² + (0.001/0.6)² = s²; of the slope s² / sum omega².
TEST(EstimateLags, TheDeviationIsThatOfALeastSquaresSlope) {
  Conditioned conditioned = three_channels();
  estimate_lags(conditioned, lagging({1.0, 2.0, 4.0}, 0.01));
  const double s2 = std::pow(0.002, 2) + std::pow(0.001 / 0.6, 2), squares = 4.0 * pi * pi * (1.0 + 4.0 + 16.0);
  EXPECT_NEAR(conditioned.quality[1].lag_std_s.value_or(9.0), std::sqrt(s2 / squares), 1e-12);
}

// Phases off the line by +d and -d, far beyond their deviation: the deviation grows by the root of cost/(n - 1).
TEST(EstimateLags, WhatTheLagLeavesWidensTheDeviation) {
  identification::Identification found = lagging({2.0, 2.0}, 0.0);
  const double d = 0.1;
  found.modes[0].shape[1] *= std::polar(1.0, d);
  found.modes[1].shape[1] *= std::polar(1.0, -d);
  Conditioned conditioned = three_channels();
  estimate_lags(conditioned, found);
  const double omega = 4.0 * pi;
  EXPECT_NEAR(conditioned.quality[1].lag_s.value_or(9.0), 0.0, 1e-12);
  // cost = 2 d²/s², over 1; information = 2 omega²/s²: sqrt(cost/information) = d/omega.
  EXPECT_NEAR(conditioned.quality[1].lag_std_s.value_or(9.0), d / omega, 1e-9);
}

TEST(EstimateLags, FewerThanTwoModesLeaveItUnknown) {
  Conditioned conditioned = three_channels();
  estimate_lags(conditioned, lagging({1.0}, 0.01));
  EXPECT_FALSE(conditioned.quality[1].lag_s.has_value());
  EXPECT_TRUE(conditioned.quality[0].lag_s.has_value());
  identification::Identification none = lagging({1.0, 2.0}, 0.01);
  none.deviations.clear();  // of a single block
  Conditioned unknown = three_channels();
  estimate_lags(unknown, none);
  EXPECT_FALSE(unknown.quality[1].lag_s.has_value());
}

// A component below five deviations has no phase: that mode does not count, and the others give the lag.
TEST(EstimateLags, AComponentWithinItsNoiseDoesNotCount) {
  identification::Identification found = lagging({1.0, 2.0, 4.0}, 0.01);
  found.modes[1].shape[1] = std::polar(0.0049, 1.0);
  Conditioned conditioned = three_channels();
  estimate_lags(conditioned, found);
  EXPECT_NEAR(conditioned.quality[1].lag_s.value_or(9.0), 0.01, 1e-12);
  found.modes[2].shape[0] = 0.0049;  // and neither where the first channel is
  Conditioned one_mode = three_channels();
  estimate_lags(one_mode, found);
  EXPECT_FALSE(one_mode.quality[1].lag_s.has_value());
}

// Several records: each row of the channel gets the lag.
TEST(EstimateLags, EachRecordsRowIsWritten) {
  Conditioned conditioned = three_channels();
  conditioned.quality.push_back(conditioned.quality[1]);
  estimate_lags(conditioned, lagging({1.0, 2.0}, 0.01));
  EXPECT_NEAR(conditioned.quality[3].lag_s.value_or(9.0), 0.01, 1e-12);
}

// Deviation sqrt(s² / sum omega²) of the test above for 1, 2 and 4 Hz: 0.0902 ms. Ten of them are 0.9 ms; ten degrees at 4 Hz
// are 6.94 ms.
TEST(LagWarning, NamesTheChannelAndItsLagWhereItMatters) {
  const auto warning = [](double lag_s, double deviation) {
    identification::Identification found = lagging({1.0, 2.0, 4.0}, lag_s);
    for (identification::ModeDeviation& d : found.deviations)
      d.shape_real = d.shape_imag = Eigen::Vector3d::Constant(deviation);
    Conditioned conditioned = three_channels();
    conditioned.setup = "S1";
    estimate_lags(conditioned, found);
    return lag_warning(conditioned, found);
  };
  const std::string late = warning(0.02, 0.001), early = warning(-0.02, 0.001);
  EXPECT_NE(late.find("setup S1: not on the clock of a: b is 20 ± 0.09 ms behind (28.8 degrees at 4 Hz)"), std::string::npos)
      << late;
  EXPECT_NE(early.find("b is 20 ± 0.09 ms ahead"), std::string::npos) << early;
  EXPECT_EQ(warning(0.0069, 0.001), "");  // 76 deviations, below ten degrees
  EXPECT_NE(warning(0.0071, 0.001), "");
  EXPECT_EQ(warning(0.02, 0.03), "");  // 7.4 deviations
  EXPECT_EQ(warning(0.0, 0.001), "");
}

}  // namespace
}  // namespace twindeck::identification
