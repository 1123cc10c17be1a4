// The two residual tests. Oracles: the chi-square law of a block given the rest, for Gaussian data of dense matrices; and what
// was put in, too small for the sum over all rows: a fault of one channel, and slopes against temperature, up in one mode and
// down in the next, as the wrong cause of a seasonal change leaves them.
#include "diagnosis/residual_test.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::ResidualTest;

ResidualTest tested(const Chain& chain, const diagnosis::FeatureSet& features) {
  const Examined e = examine(chain, features, {});
  return diagnosis::residual_test(*e.inference, e.inference->fit({}, {}));
}

TEST(ResidualTest, BlocksOfSoundDataFollowTheirLaw) {
  const Chain chain({.masses = 10, .parameters = false});
  std::mt19937_64 random(11);
  const int trials = 200;
  int sum_rejects = 0, blocks_reject = 0, below_half = 0;
  for (int i = 0; i < trials; ++i) {
    const ResidualTest test = tested(chain, chain.measure(chain.scattered(random), &random));
    sum_rejects += test.p_value < 0.05;
    blocks_reject += test.block_p_value < 0.05;
    const auto channel =
        std::find_if(test.blocks.begin(), test.blocks.end(), [](const auto& b) { return b.name == "channel c4"; });
    ASSERT_NE(channel, test.blocks.end());
    below_half += channel->p_value < 0.5;
  }
  EXPECT_LE(sum_rejects, 19);        // binomial, 200 at 5 %: 19 or fewer in 99.9 %
  EXPECT_LE(blocks_reject, 19);      // at most the level
  EXPECT_NEAR(below_half, 100, 24);  // binomial at one half, 99.9 %
}

// A shape's scale is free: one row of its block says what it is. A channel has a part of each shape.
TEST(ResidualTest, AWholeShapeHasARowLessThanItHasChannels) {
  const Chain chain({.masses = 10, .parameters = false});
  std::mt19937_64 random(14);
  const ResidualTest test = tested(chain, chain.measure(chain.scattered(random), &random));
  int shapes = 0, channels = 0;
  for (const diagnosis::BlockMisfit& block : test.blocks) {
    if (block.name.starts_with(name_of(diagnosis::RowType::shape) + " of mode")) {
      EXPECT_EQ(block.dof, block.rows - 1) << block.name;
      ++shapes;
    } else if (block.name.starts_with("channel")) {
      EXPECT_EQ(block.dof, block.rows) << block.name;
      ++channels;
    }
  }
  EXPECT_GT(shapes, 3);
  EXPECT_GT(channels, 3);
}

TEST(ResidualTest, AFaultOfOneChannelIsSeenInItsBlock) {
  const Chain chain({.masses = 10, .parameters = false});
  int named = 0, sooner = 0;
  for (int i = 0; i < 20; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(500 + i));
    auto features = chain.measure(chain.scattered(random), &random);
    int sign = 1;
    for (auto& row : features.rows)
      if (row.type == diagnosis::RowType::shape && row.channel == 3) row.value += 2.3 * row.std * (sign = -sign);
    const ResidualTest test = tested(chain, features);
    named += test.blocks.front().name == "channel c4";
    sooner += test.block_p_value < 0.1 * test.p_value;
  }
  EXPECT_GE(named, 16);
  EXPECT_GE(sooner, 14);
}

/// The frequencies of a chain on days of several temperatures; each mode's slope over the range of them in deviations of a row.
diagnosis::FeatureSet on_several_days(const Chain& chain, double slope, std::mt19937_64& random) {
  auto features = chain.measure(chain.scattered(random), nullptr);
  std::normal_distribution<double> normal;
  const std::vector<double> days = {-10.0, 0.0, 10.0, 20.0, 30.0};
  const std::vector<diagnosis::Row> sound = features.rows;
  const diagnosis::Condition nominal = features.conditions.front();
  features.rows.clear();
  features.conditions.clear();
  for (std::size_t d = 0; d < days.size(); ++d) {
    features.conditions.push_back(nominal);
    features.conditions.back().name = "day " + std::to_string(d + 1);
    features.conditions.back().temperature_C = days[d];
    int sign = 1;
    for (diagnosis::Row row : sound) {
      if (row.type != diagnosis::RowType::frequency) continue;
      row.condition = static_cast<int>(d);
      row.value += row.std * (normal(random) + (sign = -sign) * slope * (days[d] - 10.0) / 40.0);
      features.rows.push_back(row);
    }
  }
  return features;
}

const std::string kTrends = "frequency_Hz against temperature";

TEST(ResidualTest, SlopesOfSoundDataFollowTheirLaw) {
  const Chain chain({.masses = 10, .shapes = false, .parameters = false});
  std::mt19937_64 random(12);
  int below_half = 0, below_tenth = 0;
  for (int i = 0; i < 200; ++i) {
    const ResidualTest test = tested(chain, on_several_days(chain, 0.0, random));
    const auto trends = std::find_if(test.blocks.begin(), test.blocks.end(), [](const auto& b) { return b.name == kTrends; });
    ASSERT_NE(trends, test.blocks.end());
    EXPECT_EQ(trends->dof, 7);  // one a mode, and the highest is held out
    below_half += trends->p_value < 0.5;
    below_tenth += trends->p_value < 0.1;
  }
  EXPECT_NEAR(below_half, 100, 24);  // binomial, 99.9 %
  EXPECT_NEAR(below_tenth, 20, 14);
}

TEST(ResidualTest, SlopesOfSingleModesAreSeenWhereTheSumIsBlind) {
  const Chain chain({.masses = 10, .shapes = false, .parameters = false});
  std::mt19937_64 random(13);
  int named = 0, sooner = 0;
  for (int i = 0; i < 20; ++i) {
    const ResidualTest test = tested(chain, on_several_days(chain, 3.0, random));
    named += test.blocks.front().name == kTrends;
    sooner += test.block_p_value < 0.1 * test.p_value;
  }
  EXPECT_GE(named, 16);
  EXPECT_GE(sooner, 14);
}

}  // namespace
}  // namespace twindeck::tests
