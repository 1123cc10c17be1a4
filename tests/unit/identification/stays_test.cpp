// Oracles: a taut string's harmonics f_n = n c and T/m = (2 L c)².
#include "identification/stays.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "chain.hpp"

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
    sum += identification::test::Chain(1, omega_0, 0.005, rate).simulate(8000, static_cast<std::uint64_t>(40 + n), 0.0);
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
  // Four harmonics known to a thousandth leave bending open, which could lower c by a per cent or two.
  EXPECT_LT(stay.fit.c_Hz.low, 1.0);
  EXPECT_GT(stay.fit.c_Hz.high, 1.0);
  EXPECT_LT(stay.fit.c_Hz.high - stay.fit.c_Hz.low, 0.05);
  EXPECT_NEAR(stay.fit.tension_per_mass.value, std::pow(2.0 * 50.0 * stay.fit.c_Hz.value, 2), 1e-6);
}

// Without a length the setup names the stay and no force is told; c does not hang on the length but for the excess length of
// the arc, (9.81/200)²/24 = 1e-4 of c.
TEST(IdentifyStays, WithoutALengthThereIsNoForce) {
  IdentificationSettings config;
  const auto stays = identify_stays({string_record(1.0, 4)}, config);
  ASSERT_TRUE(stays.at(0).fitted);
  EXPECT_EQ(stays[0].stay, "record 7");
  EXPECT_EQ(stays[0].length_m, 0.0);
  EXPECT_EQ(stays[0].fit.tension_per_mass.value, 0.0);
  config.stays = {{"acc", 50.0}};
  EXPECT_NEAR(identify_stays({string_record(1.0, 4)}, config).at(0).fit.c_Hz.value, stays[0].fit.c_Hz.value, 3e-4);
}

// The string of before with its ends stated, and with a level of 99 %: narrower, and wider.
TEST(IdentifyStays, EndsAndLevelSetTheInterval) {
  IdentificationSettings config;
  config.stays = {{"record 7", 50.0}};
  const auto width = [&] {
    const identification::Bounded c = identify_stays({string_record(1.0, 4)}, config).at(0).fit.c_Hz;
    return c.high - c.low;
  };
  const double open = width();
  config.stay_level = 0.99;
  EXPECT_GT(width(), open);
  config.stay_level = 0.95;
  config.stays[0].ends = "hinged";
  EXPECT_LE(width(), open);
  EXPECT_EQ(identify_stays({string_record(1.0, 4)}, config).at(0).fit.clamped, 0.0);
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
