// Oracles: samples beyond a level counted before they are cut off; records that nothing has cut: noise and sines, as they are,
// in coarse counts, and locked to the clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "../signal/noise.hpp"
#include "identification/quality.hpp"

namespace twindeck::identification {
namespace {

constexpr int kLength = 30000;

Eigen::VectorXd record_of(const std::function<double(int)>& at) {
  Eigen::VectorXd x(kLength);
  for (int t = 0; t < kLength; ++t) x[t] = at(t);
  return x;
}

Eigen::VectorXd white(double step = 0.0) {
  signal::test::Noise next(7);
  return record_of([&](int) { return step > 0.0 ? step * std::round(next() / step) : next(); });
}

/// @param per_period  samples of a period @param step  of the counts; 0: none
Eigen::VectorXd sine(double per_period, double step = 0.0) {
  return record_of([&](int t) {
    const double value = std::sin(2.0 * std::numbers::pi * t / per_period);
    return step > 0.0 ? step * std::round(value / step) : value;
  });
}

long clipped(const Eigen::VectorXd& x) { return clipped_samples(x, x.minCoeff(), x.maxCoeff()); }

/// Those below the lower or above the upper rail.
long beyond(const Eigen::VectorXd& x, double low, double high) { return (x.array() < low || x.array() > high).count(); }

// White noise comes back from its rail at once: next to no runs of three, and every sample that was cut off counts.
TEST(ClippedSamples, OfAFastChannelAllAreCounted) {
  const Eigen::VectorXd x = white();
  for (const auto& [low, high] : {std::pair{-1.0, 1.0}, {-2.5, 2.0}, {-9.0, 3.0}, {-3.0, 9.0}}) {
    EXPECT_EQ(clipped(x.cwiseMax(low).cwiseMin(high)), beyond(x, low, high)) << low << " " << high;
  }
  // At 0.8 of its amplitude a sine of 4.3 samples a period leaves one or two in a row at the rail.
  const Eigen::VectorXd fast = sine(4.3 + 0.001 * std::numbers::sqrt2);
  EXPECT_EQ(clipped(fast.cwiseMax(-0.8).cwiseMin(0.8)), beyond(fast, -0.8, 0.8));
}

// 128 counts over ±2 deviations, cut there: the count below the rail has 50 samples, the rail has 680.
TEST(ClippedSamples, OfCountsTheRailStandsOut) {
  const double step = 1.0 / 32.0;
  const Eigen::VectorXd x = white(step);
  EXPECT_EQ(clipped(x.cwiseMax(-2.0).cwiseMin(2.0)), beyond(x, -2.0 + 0.5 * step, 2.0 - 0.5 * step));
}

// A maximum that occurs a few times, steps of half a deviation (16 values) and finer ones, a record without counts.
TEST(ClippedSamples, NoiseInCountsIsNotClipped) {
  for (const double step : {0.0, 1e-3, 0.02, 0.1, 0.3, 0.5}) EXPECT_EQ(clipped(white(step)), 0) << step;
  Eigen::VectorXd x = white();
  for (const int t : {100, 5000, 20000}) x[t] = 5.0;
  EXPECT_EQ(clipped(x), 0);
}

// A square wave and three counts have too few values to tell a rail.
TEST(ClippedSamples, FewValuesAreNotJudged) {
  EXPECT_EQ(clipped(record_of([](int t) { return t % 2 == 0 ? 1.0 : -1.0; })), 0);
  EXPECT_EQ(clipped(record_of([](int t) { return static_cast<double>(t % 3); })), 0);
}

// The crest of a sine is its densest place; with whole samples a period each value recurs every period.
TEST(ClippedSamples, ASineIsNotClipped) {
  for (const double step : {0.0, 1e-4, 1.0 / 64.0}) {
    for (const double per_period : {4.3 + 0.001 * std::numbers::sqrt2, 8.0, 10.0, 2.5}) {
      EXPECT_EQ(clipped(sine(per_period, step)), 0) << step << " " << per_period;
    }
  }
  EXPECT_EQ(clipped(sine(40.0)), 0);
}

TEST(ClippedSamples, MissingSamplesDoNotCount) {
  const Eigen::VectorXd x = white();
  Eigen::VectorXd cut = x.cwiseMax(-1.0).cwiseMin(1.0);
  for (int t = 0; t < kLength; t += 10) cut[t] = std::numeric_limits<double>::quiet_NaN();
  long left = 0;
  for (int t = 0; t < kLength; ++t) left += t % 10 != 0 && std::abs(x[t]) > 1.0 ? 1 : 0;
  EXPECT_EQ(clipped_samples(cut, -1.0, 1.0), left);
}

}  // namespace
}  // namespace twindeck::identification
