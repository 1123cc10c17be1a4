// Oracles: decays of oscillators in closed form, released at chosen samples.
#include "identification/releases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace twindeck::identification {
namespace {

constexpr double kRate_Hz = 100.0;

struct Oscillator {
  double frequency_Hz, damping_ratio, amplitude;
};

/// Two channels of the oscillators, released at some seconds with noise of a hundredth of the amplitude; each release ends the
/// motion before it.
Samples record_of(const std::vector<Oscillator>& oscillators, const std::vector<double>& releases_s, double seconds) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal(0.0, 0.01);
  Samples data(static_cast<Eigen::Index>(seconds * kRate_Hz), 2);
  for (Eigen::Index t = 0; t < data.rows(); ++t) {
    double since = -1.0;
    for (const double at : releases_s)
      if (const double now = static_cast<double>(t) / kRate_Hz - at; now >= 0.0) since = now;
    data(t, 0) = normal(random);
    data(t, 1) = normal(random);
    double side = 1.0;
    for (const Oscillator& o : oscillators) {
      const double omega = 2.0 * std::numbers::pi * o.frequency_Hz;
      const double q = since < 0.0 ? 0.0 : o.amplitude * std::exp(-o.damping_ratio * omega * since) * std::cos(omega * since);
      data(t, 0) += q;
      data(t, 1) += side * 0.7 * q;
      side = -side;
    }
  }
  return data;
}

TEST(Releases, EachBeginsADecayThatEndsBeforeTheNext) {
  const auto decays = decays_of(record_of({{1.3, 0.02, 1.0}, {7.4, 0.03, 0.6}}, {1.0, 12.0, 24.0}, 40.0), kRate_Hz);
  ASSERT_EQ(decays.size(), 3U);
  const std::vector<double> at = {100.0, 1200.0, 2400.0}, end = {1200.0, 2400.0, 4000.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(decays[i].first), at[i], 2.0);
    EXPECT_NEAR(static_cast<double>(decays[i].first + decays[i].second), end[i], 2.0);
  }
}

TEST(Releases, MotionThatHasNotComeToRestIsReleasedAnew) {
  const auto decays = decays_of(record_of({{1.3, 0.006, 1.0}}, {0.0, 10.0}, 20.0), kRate_Hz);
  ASSERT_EQ(decays.size(), 2U);
  EXPECT_NEAR(static_cast<double>(decays[0].first + decays[0].second), 1000.0, 2.0);
  EXPECT_NEAR(static_cast<double>(decays[1].first), 1000.0, 50.0);  // half a second holds less than a period
}

// The beat's energy rises from nothing to nearly that of the release, and falls again, four times.
TEST(Releases, ABeatIsNone) {
  for (const double apart : {0.2, 0.5, 1.0}) {
    const auto decays = decays_of(record_of({{3.0, 0.001, 1.0}, {3.0 + apart, 0.001, 1.0}}, {1.0}, 30.0), kRate_Hz);
    ASSERT_EQ(decays.size(), 1U);
    EXPECT_NEAR(static_cast<double>(decays[0].first), 100.0, 50.0);
    EXPECT_EQ(decays[0].first + decays[0].second, 3000);
  }
}

TEST(Releases, AShortOrSmallDecayIsLeftOut) {
  EXPECT_EQ(decays_of(record_of({{1.3, 0.02, 1.0}}, {1.0, 5.0}, 40.0), kRate_Hz).size(), 1U);  // a man jumps twice
  EXPECT_EQ(decays_of(record_of({{1.3, 0.02, 1.0}}, {}, 40.0), kRate_Hz).size(), 1U);          // nobody jumps
}

}  // namespace
}  // namespace twindeck::identification
