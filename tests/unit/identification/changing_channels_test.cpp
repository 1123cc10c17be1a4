// Oracle: the change itself. A record of four modes driven by white noise, with noise in each channel; one channel is then
// multiplied by a factor or put on a clock of its own.
#include "identification/changing_channels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace twindeck::identification {
namespace {

using Eigen::Index;
using std::numbers::pi;

constexpr double kChangingRate_Hz = 50.0;
constexpr Index kChangingSamples = 30000;
const std::vector<double> kChangingModes_Hz = {1.1, 1.9, 3.2, 4.6};

/// Shapes of a string at five points, each mode complex by none.
double string_shape(std::size_t channel, std::size_t mode) {
  return std::sin(pi * static_cast<double>((mode + 1) * (channel + 1)) / 6.3);
}

Identification modes_of_string(std::size_t channels) {
  Identification found;
  for (std::size_t m = 0; m < kChangingModes_Hz.size(); ++m) {
    Cluster mode;
    mode.frequency_Hz = kChangingModes_Hz[m];
    mode.damping_ratio = 0.01;
    mode.shape.resize(static_cast<Index>(channels));
    for (std::size_t c = 0; c < channels; ++c) mode.shape[static_cast<Index>(c)] = string_shape(c, m);
    found.modes.push_back(mode);
  }
  return found;
}

/// Damped oscillators under white noise. The last channel's samples are taken at t (1 + skew).
Conditioned string_record(std::size_t channels, double skew, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Conditioned out;
  out.setup = "S1";
  out.rate_Hz = kChangingRate_Hz;
  out.files = {"a.csv"};
  Samples record(kChangingSamples, static_cast<Index>(channels));
  record.setZero();
  for (std::size_t m = 0; m < kChangingModes_Hz.size(); ++m) {
    const double omega = 2.0 * pi * kChangingModes_Hz[m] / kChangingRate_Hz;
    const std::complex<double> step = std::exp(std::complex<double>(-0.01 * omega, omega));
    std::complex<double> state = 0.0;
    const std::complex<double> slope(-0.01 * omega, omega);
    for (Index t = 0; t < kChangingSamples; ++t) {
      state = step * state + std::complex<double>(normal(random), normal(random));
      for (std::size_t c = 0; c < channels; ++c) {
        const double late = c + 1 == channels ? skew * static_cast<double>(t) : 0.0;  // [samples]
        record(t, static_cast<Index>(c)) += string_shape(c, m) * (state * std::exp(-slope * late)).real();
      }
    }
  }
  for (double& x : record.reshaped()) x += 0.3 * normal(random);
  out.records.push_back(std::move(record));
  for (std::size_t c = 0; c < channels; ++c) out.channels.emplace_back().name = "c" + std::to_string(c + 1);
  return out;
}

TEST(ChangesWithinRecords, SoundChannelsHaveNone) {
  for (unsigned seed = 1; seed <= 8; ++seed)
    for (const std::size_t channels : {2U, 5U})
      EXPECT_TRUE(changes_within_records(string_record(channels, 0.0, seed), modes_of_string(channels)).empty()) << seed;
}

TEST(ChangesWithinRecords, AChangedGainIsSaidWithItsFactor) {
  Conditioned changed = string_record(5, 0.0, 11);
  changed.records[0].col(2).tail(kChangingSamples / 2) *= 0.7;
  const auto lines = changes_within_records(changed, modes_of_string(5));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("a.csv: from 300 s on c3 has 0.7"), std::string::npos) << lines[0];
}

TEST(ChangesWithinRecords, AReversedSensorIsSaid) {
  Conditioned changed = string_record(5, 0.0, 12);
  changed.records[0].col(1).tail(kChangingSamples / 2) *= -1.0;
  const auto lines = changes_within_records(changed, modes_of_string(5));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("from 300 s on c2 is reversed"), std::string::npos) << lines[0];
}

// 0.02 % of 150 s are 30 ms, 50 degrees at 4.6 Hz.
TEST(ChangesWithinRecords, AClockOfAnotherSpeedIsSaidWithItsRate) {
  const auto lines = changes_within_records(string_record(5, 2e-4, 13), modes_of_string(5));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("c5 is "), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("ms late (a clock 0.02 % slow"), std::string::npos) << lines[0];
}

}  // namespace
}  // namespace twindeck::identification
