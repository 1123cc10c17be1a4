// Oracles: rows of two shapes whose turn into each other is written out by hand.
#include "diagnosis/features/shape_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::tests {
namespace {

using diagnosis::common_rows;
using diagnosis::turn_of_shapes;
using Eigen::VectorXd;

const std::vector<int> kLowRows = {0, 1, 2}, kLowChannels = {7, 4, 5}, kHighRows = {3, 4, 5}, kHighChannels = {5, 9, 7};

TEST(CommonRows, AreThoseOfTheSameChannelsInAnyOrder) {
  const auto common = common_rows({kLowRows, kLowChannels}, {kHighRows, kHighChannels});
  EXPECT_EQ(common.first, (std::vector<int>{0, 2}));
  EXPECT_EQ(common.second, (std::vector<int>{5, 3}));
  const std::vector<int> none;
  EXPECT_TRUE(common_rows({kLowRows, kLowChannels}, {none, none}).first.empty());
}

TEST(ShapeTurn, GainsTheOtherAtItsOwnSizeAndLeavesTheRestOpen) {
  VectorXd values(6);
  values << 3.0, 1.0, 4.0, 6.0, 2.0, 8.0;
  const auto turn = turn_of_shapes({kLowRows, kLowChannels}, {kHighRows, kHighChannels}, values);
  // Common: 3 and 4 of the low shape (size 5), 8 and 6 of the high one (size 10).
  VectorXd together(6), alone = VectorXd::Zero(6);
  together << 4.0, 0.0, 3.0, -8.0, 0.0, -6.0;
  alone[1] = std::sqrt(26.0 / 3.0);
  alone[4] = std::sqrt(104.0 / 3.0);
  EXPECT_LT((turn.together - together).norm(), 1e-12);
  EXPECT_LT((turn.alone - alone).norm(), 1e-12);
}

TEST(ShapeTurn, OfShapesWithoutACommonChannelIsOpenInEveryRow) {
  const VectorXd values = VectorXd::Constant(6, 2.0);
  const std::vector<int> others = {1, 2, 3};
  const auto turn = turn_of_shapes({kLowRows, kLowChannels}, {kHighRows, others}, values);
  EXPECT_EQ(turn.together, VectorXd::Zero(6));
  EXPECT_EQ(turn.alone, values);
}

}  // namespace
}  // namespace twindeck::tests
