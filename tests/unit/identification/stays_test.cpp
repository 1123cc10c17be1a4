// Oracles: a taut string's harmonics f_n = n c and T/m = (2 L c)²; a change of length scales T/m by its square.
#include "identification/stays.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../sysid/chain.hpp"

namespace twindeck::identification {
namespace {

TEST(StaySettingsOf, TakeTheStaysLimitsAndDropThoseOfTheBridge) {
  IdentificationSettings config;
  config.references = {"a"};
  config.exclude = {"b"};
  config.method = "data";
  config.lowest_Hz = 0.2;
  config.highest_Hz = 2.0;
  config.stay_block_rows = 77;
  config.stay_maximum_order = 33;
  const IdentificationSettings own = stay_settings(config);
  EXPECT_TRUE(own.references.empty() && own.exclude.empty());
  EXPECT_EQ(own.method, "covariance");
  EXPECT_EQ(own.block_rows, 77);
  EXPECT_EQ(own.maximum_order, 33);
  EXPECT_EQ(own.lowest_Hz, 0.0);
  EXPECT_EQ(own.highest_Hz, 0.0);
  EXPECT_EQ(own.periodic.largest_damping, 0.0);
  EXPECT_EQ(own.stay_highest_Hz, config.stay_highest_Hz);
}

/// One accelerometer on a string: modes n c in white noise, half a per cent of damping.
Conditioned string_record(double c_Hz, int harmonics) {
  const double rate = 12.5;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(8000);
  for (int n = 1; n <= harmonics; ++n) {
    // A chain of one mass has omega = sqrt(2) omega_0.
    const double omega_0 = 2.0 * std::numbers::pi * n * c_Hz / std::sqrt(2.0);
    sum += sysid::test::Chain(1, omega_0, 0.005, rate).simulate(8000, static_cast<std::uint64_t>(40 + n), 0.0);
  }
  Conditioned conditioned;
  conditioned.setup = "record 7";
  conditioned.condition = "summer";
  conditioned.channels.resize(1);
  conditioned.channels[0].name = "acc";
  conditioned.channels[0].point = "C1";
  conditioned.references = {0};
  conditioned.rate_Hz = rate;
  conditioned.records.emplace_back(sum);
  conditioned.files = {"stay.csv"};
  return conditioned;
}

// The lower limit for a frequency in N cycles is f sqrt(zeta/(2 pi N)): 0.1 % of 1 Hz in 640 s. Five deviations of c, which the
// fit gives, hold it; the deviations themselves are below 1 %.
TEST(IdentifyStays, ATautStringHasItsSpacingAndForce) {
  IdentificationSettings config;
  config.stays = {{"C1", 50.0}};
  const auto stays = identify_stays({string_record(1.0, 4)}, config);
  ASSERT_EQ(stays.size(), 1U);
  const StayResult& stay = stays[0];
  EXPECT_EQ(stay.stay, "C1");  // found by its point
  EXPECT_EQ(stay.length_m, 50.0);
  ASSERT_GE(stay.modes.size(), 3U);
  for (const StayResult::Mode& mode : stay.modes) {
    EXPECT_NEAR(mode.frequency_Hz, mode.harmonic * 1.0, 5.0 * mode.frequency_std_Hz + 1e-3) << mode.harmonic;
    EXPECT_GT(mode.frequency_std_Hz, 0.0);
  }
  ASSERT_TRUE(stay.fitted);
  const double half = 0.5 * (stay.fit.c_Hz.high - stay.fit.c_Hz.low) / 1.96;  // a deviation
  EXPECT_NEAR(stay.fit.c_Hz.value, 1.0, 5.0 * half);
  EXPECT_LT(half, 0.01);
  EXPECT_NEAR(stay.fit.tension_per_mass.value, std::pow(2.0 * 50.0 * stay.fit.c_Hz.value, 2), 1e-6);
}

// Without a length the setup names the stay and T/m is that of 1 m; c does not hang on the length.
TEST(IdentifyStays, WithoutALengthTheFitIsOfOneMetre) {
  IdentificationSettings config;
  const auto stays = identify_stays({string_record(1.0, 4)}, config);
  ASSERT_TRUE(stays.at(0).fitted);
  EXPECT_EQ(stays[0].stay, "record 7");
  EXPECT_EQ(stays[0].length_m, 0.0);
  const double c = stays[0].fit.c_Hz.value;
  EXPECT_NEAR(stays[0].fit.tension_per_mass.value, 4.0 * c * c, 1e-9);
  config.stays = {{"acc", 50.0}};
  const sysid::StayFit known = identify_stays({string_record(1.0, 4)}, config).at(0).fit;
  EXPECT_NEAR(known.c_Hz.value, c, 1e-12);
  // Of 50 m at 1 Hz the excess length is (9.81/200)²/24 = 1e-4 of c: the interval without it is no wider, and a little
  // narrower.
  const double known_half = known.c_Hz.high - known.c_Hz.value, half = stays[0].fit.c_Hz.high - c;
  EXPECT_LE(half, known_half);
  EXPECT_NEAR(std::hypot(half, 1.96 * 1e-4), known_half, 1e-5);
}

// 95 % are 1.959964 deviations to either side, 99 % are 2.575829 (tables of the normal law).
TEST(IdentifyStays, TheLevelIsTwoSided) {
  IdentificationSettings config;
  config.stays = {{"record 7", 50.0}};
  for (const auto& [level, quantile] : {std::pair{0.95, 1.959964}, std::pair{0.99, 2.575829}}) {
    config.stay_level = level;
    const StayResult stay = identify_stays({string_record(1.0, 4)}, config).at(0);
    std::vector<sysid::Harmonic> harmonics;
    for (const StayResult::Mode& mode : stay.modes)
      harmonics.push_back({mode.harmonic, mode.frequency_Hz, mode.frequency_std_Hz});
    EXPECT_NEAR(stay.fit.c_Hz.high, sysid::fit_stay(harmonics, 50.0, quantile).c_Hz.high, 1e-8) << level;
  }
}

// Two harmonics are asked for at most; and one harmonic alone is no fit.
TEST(IdentifyStays, NoMoreHarmonicsThanAsked) {
  IdentificationSettings config;
  config.stay_harmonics = 2;
  const auto stays = identify_stays({string_record(1.0, 4)}, config);
  ASSERT_EQ(stays.at(0).modes.size(), 2U);
  EXPECT_EQ(stays[0].modes.back().harmonic, 2);
  EXPECT_TRUE(stays[0].fitted);
  config.stay_harmonics = 1;
  EXPECT_FALSE(identify_stays({string_record(1.0, 4)}, config).at(0).fitted);
  EXPECT_TRUE(identify_stays({}, config).empty());
}

}  // namespace
}  // namespace twindeck::identification
