// Oracles: frequencies and shapes of a chain in closed form; a setup's gain and the order of setups change nothing.
#include "identification/condition.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../heard_reporter.hpp"
#include "chain.hpp"
#include "modal/mac.hpp"

namespace twindeck::identification {
namespace {

using Positions = std::vector<Eigen::Index>;

const identification::test::Chain kFourMasses(4, 14.0, 0.01, 12.5);  // 1.38, 2.62, 3.61 and 4.24 Hz

/// A setup whose sensors stand at these masses, named m0 … m3; the first two stay.
SetupResult setup_at(const Positions& masses, double gain, const IdentificationSettings& limits) {
  SetupResult setup;
  setup.conditioned.setup = "S" + std::to_string(masses.back());
  setup.conditioned.condition = "summer";
  for (const Eigen::Index mass : masses) {
    records::CampaignChannel& channel = setup.conditioned.channels.emplace_back();
    channel.name = "m" + std::to_string(mass);
    setup.conditioned.quality.emplace_back().channel = channel.name;
  }
  setup.conditioned.references = {0, 1};
  setup.conditioned.rate_Hz = 12.5;
  const Eigen::MatrixXd all = gain * kFourMasses.simulate(9000, static_cast<std::uint64_t>(60 + masses.back()), 0.02);
  setup.conditioned.records.emplace_back(Eigen::MatrixXd(all(Eigen::all, masses)));
  setup.conditioned.files = {"r.csv"};
  setup.limits = limits;
  return setup;
}

IdentificationSettings three_modes() {
  IdentificationSettings config;
  config.block_rows = 20;
  config.maximum_order = 24;
  config.highest_Hz = 4.0;
  config.welch_segment = 512;
  return config;
}

/// Masses 0 and 3 stay; 1 and 2 are one setup each.
ConditionResult identified_chain(const IdentificationSettings& config, double gain = 1.0, bool turned = false) {
  ConditionResult result;
  result.condition = "summer";
  result.channels.resize(4);
  for (std::size_t i = 0; i < 4; ++i) result.channels[i].name = "m" + std::to_string(i);
  result.setups = {setup_at({0, 3, 1}, 1.0, config), setup_at({0, 3, 2}, gain, config)};
  if (turned) std::swap(result.setups[0], result.setups[1]);
  Reporter nobody;
  identify_condition(result, config, nobody);
  return result;
}

/// Three modes are those of the chain. A MAC of 0.99 and 0.5 % are some deviations in 720 s.
void expect_modes(const ConditionResult& result) {
  ASSERT_EQ(result.modes.size(), 3U);
  for (int r = 0; r < 3; ++r) {
    const identification::MergedMode& mode = result.modes[static_cast<std::size_t>(r)];
    EXPECT_NEAR(mode.frequency_Hz / kFourMasses.frequency_Hz(r), 1.0, 0.005);
    EXPECT_EQ(mode.members.size(), 2U);
    const Eigen::MatrixXcd truth = kFourMasses.shape(r).cast<std::complex<double>>();
    EXPECT_GT(modal::mac(truth, Eigen::MatrixXcd(mode.shape))(0, 0), 0.99) << r;
  }
}

TEST(IdentifyCondition, TwoSetupsGiveTheModesOfTheChain) {
  const ConditionResult result = identified_chain(three_modes());
  expect_modes(result);
  ASSERT_EQ(result.checks.size(), 3U);
  for (const MergingCheck& check : result.checks) {
    EXPECT_TRUE(check.found);
    EXPECT_GT(check.mac, 0.98);  // PoSER and PreGER take the same records
  }
  for (const SetupResult& setup : result.setups) {
    EXPECT_EQ(setup.spectra.density.cols(), 3);
    EXPECT_EQ(setup.singular.values.cols(), 3);
    EXPECT_NEAR(setup.conditioned.quality[0].lag_s.value_or(9.0), 0.0, 0.0);
  }
}

// Records are scaled to unit RMS, so that a setup's gain is gone up to rounding.
TEST(IdentifyCondition, ASetupsGainAndTheOrderOfSetupsChangeNothing) {
  const ConditionResult one = identified_chain(three_modes()), gained = identified_chain(three_modes(), 50.0),
                        turned = identified_chain(three_modes(), 1.0, true);
  ASSERT_EQ(gained.modes.size(), one.modes.size());
  ASSERT_EQ(turned.modes.size(), one.modes.size());
  for (std::size_t m = 0; m < one.modes.size(); ++m) {
    for (const ConditionResult* other : {&gained, &turned}) {
      EXPECT_NEAR(other->modes[m].frequency_Hz, one.modes[m].frequency_Hz, 1e-7);
      EXPECT_LT((other->modes[m].shape - one.modes[m].shape).norm(), 1e-6);
    }
  }
}

// A recorder with another gain, or ten times the wind in one setup, tells nothing of the structure: PreGER divides each setup
// by its own level, so that a gain is gone up to rounding. Partners, MAC and deviations with it.
TEST(IdentifyCondition, ASetupsGainChangesNothingOfPreger) {
  IdentificationSettings config = three_modes();
  for (const char* merge : {"poser", "preger"}) {
    config.merge = merge;
    const ConditionResult one = identified_chain(config), gained = identified_chain(config, 50.0);
    ASSERT_EQ(gained.modes.size(), one.modes.size());
    for (std::size_t m = 0; m < one.modes.size(); ++m) {
      EXPECT_NEAR(gained.modes[m].frequency_Hz, one.modes[m].frequency_Hz, 1e-7) << merge;
      EXPECT_NEAR(gained.modes[m].damping_ratio, one.modes[m].damping_ratio, 1e-7) << merge;
      EXPECT_NEAR(gained.modes[m].deviation.frequency_Hz, one.modes[m].deviation.frequency_Hz, 1e-7) << merge;
      EXPECT_LT((gained.modes[m].shape - one.modes[m].shape).norm(), 1e-6) << merge;
      EXPECT_NEAR(gained.checks[m].frequency_Hz, one.checks[m].frequency_Hz, 1e-7) << merge;
      EXPECT_NEAR(gained.checks[m].damping_ratio, one.checks[m].damping_ratio, 1e-7) << merge;
      EXPECT_NEAR(gained.checks[m].mac, one.checks[m].mac, 1e-7) << merge;
    }
  }
}

// One sample is 0.08 s: at the third mode, 3.6 Hz, a turn of 104 degrees. The step's warnings go to the manifest.
TEST(IdentifyCondition, AChannelThatLagsIsNamedInAWarning) {
  IdentificationSettings config = three_modes();
  ConditionResult result;
  result.setups = {setup_at({0, 1, 2, 3}, 1.0, config)};
  result.channels = result.setups.front().conditioned.channels;
  tests::HeardReporter sound, late;
  ConditionResult lagging = result;
  identify_condition(result, config, sound);
  EXPECT_TRUE(sound.warned.empty());
  Samples& record = lagging.setups.front().conditioned.records.front();
  const Eigen::VectorXd before = record.col(2).head(record.rows() - 1);
  record.col(2).tail(before.size()) = before;
  identify_condition(lagging, config, late);
  ASSERT_EQ(late.warned.size(), 1U);
  EXPECT_NE(late.warned[0].find("m2 is "), std::string::npos) << late.warned[0];
}

// merge = "preger": frequency, damping and shape are PreGER's; the deviation is the root of the sum of squares of PoSER's and
// the difference of both. The check keeps PoSER's values.
TEST(IdentifyCondition, PregerReplacesTheValuesAndItsDeviationsHoldTheDifference) {
  IdentificationSettings config = three_modes();
  const ConditionResult poser = identified_chain(config);
  config.merge = "preger";
  const ConditionResult preger = identified_chain(config);
  expect_modes(preger);
  for (std::size_t m = 0; m < preger.modes.size(); ++m) {
    EXPECT_EQ(preger.modes[m].frequency_Hz, preger.checks[m].frequency_Hz);
    EXPECT_EQ(preger.modes[m].damping_ratio, preger.checks[m].damping_ratio);
    const double shift_Hz = preger.modes[m].frequency_Hz - poser.modes[m].frequency_Hz,
                 shift = preger.modes[m].damping_ratio - poser.modes[m].damping_ratio;
    EXPECT_NE(shift_Hz, 0.0);
    EXPECT_NEAR(preger.modes[m].deviation.frequency_Hz, std::hypot(poser.modes[m].deviation.frequency_Hz, shift_Hz), 1e-15);
    EXPECT_NEAR(preger.modes[m].deviation.damping_ratio, std::hypot(poser.modes[m].deviation.damping_ratio, shift), 1e-15);
    EXPECT_EQ(preger.checks[m].poser_frequency_Hz, poser.modes[m].frequency_Hz);
    EXPECT_EQ(preger.checks[m].poser_damping_ratio, poser.modes[m].damping_ratio);
  }
}

}  // namespace
}  // namespace twindeck::identification
