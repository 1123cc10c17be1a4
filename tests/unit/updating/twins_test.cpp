// Oracle: two masses between walls, symmetric (measured_chain.hpp). Both end springs move both frequencies alike. The middle
// one moves the second frequency alone.
#include <gtest/gtest.h>

#include "measured_chain.hpp"
#include "updating/weighing_words.hpp"

namespace twindeck::updating {
namespace {

using Names = std::vector<std::vector<std::string>>;

Names twins_of(const SmallSystem& small, double std_Hz, const std::vector<int>& active = {0, 1, 2}, Eigen::Index pairs = 2) {
  const dynamics::LoadedModel model = loaded(small);
  const dynamics::EigenModes modes = modes_of(model);
  const matching::Measured measured = measured_frequencies(modes.frequency_Hz.head(pairs), std_Hz);
  return indistinct_parameters(model, modes, active, measured, matching::pair_by_order(measured, 2));
}

TEST(Twins, AreTheEndsOfASymmetricChain) { EXPECT_EQ(twins_of(two_masses(), 0.01), (Names{{"left", "right"}})); }

TEST(Twins, AreNoneWhereTheChainIsNotSymmetric) { EXPECT_EQ(twins_of(two_masses(3.0), 0.01), Names{}); }

// Half the range of an end spring changes f1 = 3.18 Hz by f1/8 = 0.40 Hz and f2 = 3.90 Hz by f2/12 = 0.32 Hz: 0.51 Hz together.
TEST(Twins, AreNoneWhereNothingMovesTheFrequenciesByADeviation) {
  EXPECT_EQ(twins_of(two_masses(), 0.50), (Names{{"left", "right"}}));
  EXPECT_EQ(twins_of(two_masses(), 0.53), Names{});
}

TEST(Twins, AreNamedByTheirPlaceInTheModel) {
  EXPECT_EQ(twins_of(two_masses(), 0.01, {2, 0}), (Names{{"right", "left"}}));
  EXPECT_EQ(named_sets(loaded(two_masses()), {2, 1}, {{0, 1}, {1}}), (Names{{"right", "middle"}, {"middle"}}));
}

// By Rayleigh's quotient an end spring and the middle one raise omega² of mode 2 alike, by 200 times their factor; the middle
// one does nothing to mode 1. One measured mode is paired with either.
TEST(Twins, AreOfThePairedFrequencies) {
  const dynamics::LoadedModel model = loaded(two_masses());
  const dynamics::EigenModes modes = modes_of(model);
  const matching::Measured measured = measured_frequencies(modes.frequency_Hz, 0.01);
  matching::Pairing pairing;
  pairing.pairs = {{1, 1, 1.0, false}};
  EXPECT_EQ(indistinct_parameters(model, modes, {0, 1}, measured, pairing), (Names{{"left", "middle"}}));
  pairing.pairs = {{1, 0, 1.0, false}};
  EXPECT_EQ(indistinct_parameters(model, modes, {0, 1, 2}, measured, pairing), (Names{{"left", "right"}}));
}

TEST(Twins, AreWarnedOfOnceASet) {
  HeardReporter heard;
  warn_of_twins(heard, {{"left", "right"}, {"a", "b", "c"}}, false);
  warn_of_twins(heard, {{"left", "right"}}, true);
  ASSERT_EQ(heard.warned.size(), 3U);
  EXPECT_NE(heard.warned[0].find("left, right"), std::string::npos);
  EXPECT_NE(heard.warned[1].find("a, b, c"), std::string::npos);
  EXPECT_EQ(heard.warned[0].find("residuals = "), std::string::npos);
  EXPECT_NE(heard.warned[2].find("residuals = "), std::string::npos);  // shapes were measured: they can be weighed
}

}  // namespace
}  // namespace twindeck::updating
