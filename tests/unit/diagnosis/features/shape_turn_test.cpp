// Oracles: rows of two shapes whose turn into each other is written out by hand.
#include "diagnosis/features/shape_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::tests {
namespace {

using diagnosis::common_rows;
using diagnosis::turn_of_shapes;
using Eigen::VectorXd;

const std::vector<int> kLowRows = {0, 1, 2, 3}, kLowChannels = {7, 4, 5, 6}, kHighRows = {4, 5, 6, 7},
                       kHighChannels = {5, 9, 7, 6};

TEST(CommonRows, AreThoseOfTheSameChannelsInAnyOrder) {
  const auto common = common_rows({kLowRows, kLowChannels}, {kHighRows, kHighChannels});
  EXPECT_EQ(common.first, (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(common.second, (std::vector<int>{6, 4, 7}));
  EXPECT_TRUE(common.most);  // three of four
  const std::vector<int> none;
  EXPECT_TRUE(common_rows({kLowRows, kLowChannels}, {none, none}).first.empty());
  EXPECT_FALSE(common_rows({kLowRows, kLowChannels}, {none, none}).most);
}

TEST(ShapeTurn, GainsTheOtherAtItsOwnSizeAndLeavesTheRestOpen) {
  VectorXd values(8);
  values << 3.0, 1.0, 4.0, 0.0, 6.0, 2.0, 8.0, 0.0;
  const auto turn = turn_of_shapes({kLowRows, kLowChannels}, {kHighRows, kHighChannels}, values);
  // Common: 3, 4 and 0 of the low shape (size 5), 8, 6 and 0 of the high one (size 10).
  VectorXd together(8), alone = VectorXd::Zero(8);
  together << 4.0, 0.0, 3.0, 0.0, -8.0, 0.0, -6.0, 0.0;
  alone[1] = std::sqrt(26.0 / 4.0);
  alone[5] = std::sqrt(104.0 / 4.0);
  EXPECT_LT((turn.together - together).norm(), 1e-12);
  EXPECT_LT((turn.alone - alone).norm(), 1e-12);
}

TEST(ShapeTurn, OfShapesWithFewCommonChannelsIsLeftOut) {
  const VectorXd values = VectorXd::Constant(8, 2.0);
  const std::vector<int> two_of_four = {7, 4, 1, 2};
  const auto turn = turn_of_shapes({kLowRows, kLowChannels}, {kHighRows, two_of_four}, values);
  EXPECT_EQ(turn.together, VectorXd::Zero(8));
  EXPECT_EQ(turn.alone, VectorXd::Zero(8));
}

}  // namespace
}  // namespace twindeck::tests
