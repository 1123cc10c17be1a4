// Oracles: frequencies of the oscillators that the records are made of; hand counts of rates and rows.
#include "identification/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "chain.hpp"

namespace twindeck::identification {
namespace {

/// One mass on a spring under white noise: omega = sqrt(2) omega_0.
Samples oscillator(double frequency_Hz, double rate_Hz, Eigen::Index samples, std::uint64_t seed) {
  const double omega_0 = 2.0 * std::numbers::pi * frequency_Hz / std::sqrt(2.0);
  return identification::test::Chain(1, omega_0, 0.01, rate_Hz).simulate(samples, seed, 0.0);
}

IdentificationSettings open_settings() {
  IdentificationSettings config;
  config.decimation = config.block_rows = 0;
  return config;
}

// At 200 Hz a mode at 2 Hz needs 6 Hz: 200/6 = 33, and peaks of a spectrum lie within a line or two (0.03 Hz) of the mode.
// Three periods are 1.5 s.
TEST(ChooseSampling, ARateOfThreeTimesThePeakAndThreePeriodsABlock) {
  const std::vector<Samples> records = {oscillator(2.0, 200.0, 60000, 7)};
  const Sampling chosen = choose_sampling(records, 200.0, open_settings());
  EXPECT_NEAR(chosen.lowest_Hz, 2.0, 0.1);
  const double rate = 200.0 / static_cast<double>(chosen.decimation);
  EXPECT_GE(rate, 3.0 * chosen.highest_Hz);
  EXPECT_GE(static_cast<double>(chosen.block_rows) / rate, 3.0 / chosen.lowest_Hz - 1e-9);
  EXPECT_GE(chosen.decimation, 5);
}

TEST(ChooseSampling, WhatIsConfiguredStays) {
  const std::vector<Samples> records = {oscillator(2.0, 200.0, 60000, 7)};
  IdentificationSettings config = open_settings();
  config.decimation = 4;
  config.block_rows = 33;
  const Sampling chosen = choose_sampling(records, 200.0, config);
  EXPECT_EQ(chosen.decimation, 4);
  EXPECT_EQ(chosen.block_rows, 33);
}

// Three periods of 2 Hz at 200 Hz are 300 rows; 1600 rows of all channels are 100 of sixteen.
TEST(ChooseSampling, ManyChannelsCarryFewerRowsAndTheNoteSaysSo) {
  const std::vector<Samples> records = {oscillator(2.0, 200.0, 60000, 7).replicate(1, 16)};
  IdentificationSettings config = open_settings();
  config.decimation = 1;
  const Sampling chosen = choose_sampling(records, 200.0, config);
  EXPECT_EQ(chosen.block_rows, 100);
  EXPECT_NE(chosen.note.find("3 periods of the lowest peak need 3"), std::string::npos) << chosen.note;
  EXPECT_NE(chosen.note.find("more than 16 channels carry"), std::string::npos) << chosen.note;
}

// White noise has no peak: its lines scatter about their median by less than a factor of five in nineteen averages.
TEST(ChooseSampling, NoiseIsTakenAsItIs) {
  signal::test::Noise noise(3);
  Samples record(20000, 1);
  for (Eigen::Index t = 0; t < record.rows(); ++t) record(t, 0) = noise();
  const Sampling chosen = choose_sampling({record}, 100.0, open_settings());
  EXPECT_EQ(chosen.decimation, 1);
  EXPECT_EQ(chosen.lowest_Hz, 0.0);
  EXPECT_NE(chosen.note.find("no peak"), std::string::npos);
}

// A decay of 1 Hz with 2 % and one of 15 Hz with 8 %, at 1000 Hz: the higher one has no sharp peak, but motion reaches it.
TEST(ChooseDecaySampling, TheRateHoldsWhatIsHeavilyDamped) {
  const double rate = 1000.0;
  Samples record(30000, 1);
  for (Eigen::Index k = 0; k < record.rows(); ++k) {
    const double t = static_cast<double>(k) / rate, w = 2.0 * std::numbers::pi;
    record(k, 0) = std::exp(-0.02 * w * t) * std::cos(w * t) + std::exp(-0.08 * 15.0 * w * t) * std::cos(15.0 * w * t);
  }
  const Sampling chosen = choose_decay_sampling({record}, rate, open_settings());
  EXPECT_NEAR(chosen.lowest_Hz, 1.0, 0.1);
  EXPECT_GE(rate / static_cast<double>(chosen.decimation), 12.0 * 15.0);
  EXPECT_GT(chosen.decimation, 0);
}

TEST(SpectralPeaks, StandAboveTheirNeighbourhood) {
  const Eigen::VectorXd frequency = Eigen::VectorXd::LinSpaced(201, 0.0, 20.0);
  Eigen::VectorXd density = Eigen::VectorXd::Ones(201);
  density[50] = 6.0;
  density[120] = 4.0;
  EXPECT_EQ(spectral_peaks(frequency, density, 5.0, 0.0, 0.0), std::vector<double>{frequency[50]});
  EXPECT_EQ(spectral_peaks(frequency, density, 3.0, 6.0, 0.0), std::vector<double>{frequency[120]});
  EXPECT_TRUE(spectral_peaks(frequency, density, 3.0, 6.0, 10.0).empty());
}

}  // namespace
}  // namespace twindeck::identification
