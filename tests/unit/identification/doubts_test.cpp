// Oracles: hand-made modes and spectra, each with one thing to doubt.
#include "identification/doubts.hpp"

#include <gtest/gtest.h>

namespace twindeck::identification {
namespace {

/// A setup at 10 Hz with 30 block rows (3 s) and modes of 1 % at these frequencies, shapes of two channels.
ConditionResult with_modes(const std::vector<double>& frequencies_Hz) {
  ConditionResult result;
  result.channels.resize(2);
  SetupResult setup;
  setup.conditioned.setup = "S1";
  setup.conditioned.rate_Hz = 10.0;
  setup.limits.block_rows = 30;
  setup.limits.highest_Hz = 4.0;
  setup.singular.frequency_Hz = Eigen::VectorXd::LinSpaced(501, 0.0, 5.0);
  setup.singular.values = Eigen::MatrixXd::Ones(501, 1);
  for (std::size_t m = 0; m < frequencies_Hz.size(); ++m) {
    identification::MergedMode& mode = result.modes.emplace_back();
    mode.frequency_Hz = frequencies_Hz[m];
    mode.damping_ratio = 0.01;
    mode.deviation.frequency_Hz = 0.002;
    mode.deviation.damping_ratio = 0.001;
    mode.shape = Eigen::Vector2cd(1.0, m % 2 == 0 ? 0.5 : -0.5);
    identification::Cluster& own = setup.found.modes.emplace_back();
    own.frequency_Hz = frequencies_Hz[m];
    own.damping_ratio = 0.01;
  }
  result.setups.push_back(std::move(setup));
  return result;
}

TEST(DoubtsOf, SoundModesHaveNone) { EXPECT_TRUE(doubts_of(with_modes({0.8, 1.2, 1.9, 2.6})).empty()); }

// Two periods of 0.5 Hz are 4 s, 40 rows.
TEST(DoubtsOf, ABlockIsShorterThanTwoPeriods) {
  const auto doubts = doubts_of(with_modes({0.5, 1.2}));
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_NE(doubts[0].find("block_rows to 40"), std::string::npos) << doubts[0];
}

// Two periods of 0.63 Hz are 32 rows of 10 Hz. A peak of the spectrum, by which step 3 chooses, is known to a line only.
TEST(DoubtsOf, ABlockThatMissesTwoPeriodsByALineIsLongEnough) { EXPECT_TRUE(doubts_of(with_modes({0.63, 1.2})).empty()); }

TEST(DoubtsOf, ADampingRatioIsFarFromTheOthers) {
  ConditionResult result = with_modes({0.8, 1.2, 1.9, 2.6});
  result.modes[2].damping_ratio = 0.06;
  const auto doubts = doubts_of(result);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_NE(doubts[0].find("mode 3"), std::string::npos) << doubts[0];
  result.modes[2].deviation.damping_ratio = 0.02;  // known so badly, it may be 4 %
  EXPECT_TRUE(doubts_of(result).empty());
}

TEST(DoubtsOf, APeakHasNoMode) {
  ConditionResult result = with_modes({0.8, 1.2});
  result.setups[0].singular.values(120, 0) = 50.0;  // of the second mode
  result.setups[0].singular.values(300, 0) = 50.0;  // 3.0 Hz
  const auto doubts = doubts_of(result);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_NE(doubts[0].find("at 3 Hz"), std::string::npos) << doubts[0];
  result.setups[0].found.periodic.emplace_back().frequency_Hz = 3.0;
  EXPECT_TRUE(doubts_of(result).empty());
}

}  // namespace
}  // namespace twindeck::identification
