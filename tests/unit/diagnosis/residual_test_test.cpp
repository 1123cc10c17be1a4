// The two residual tests. Oracles: the chi-square law of a block given the rest, for Gaussian data of dense matrices; and a
// fault of one channel that was put in, too small for the sum over all rows.
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

}  // namespace
}  // namespace twindeck::tests
