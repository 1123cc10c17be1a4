// Oracles: the header's rule (a tenth of the largest), an eigenvector by hand.
#include <gtest/gtest.h>

#include <limits>

#include "fe/mechanism.hpp"

namespace twindeck::fe {
namespace {

std::vector<DofLabel> two_nodes() {
  std::vector<DofLabel> dofs;
  for (const char* node : {"7", "12"})
    for (int d = 0; d < 6; ++d) dofs.push_back({node, d, {1.0, -2.5, node[0] == '7' ? 0.0 : 3.0}});
  return dofs;
}

TEST(MotionWords, NamesTheNodeThatMovesMostAndItsDirections) {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(12);
  motion[0] = 0.9;      // node 7: less than the largest
  motion[6] = 0.099;    // below a tenth
  motion[8] = -1.0;     // the largest, whatever its sign
  motion[10] = 0.1001;  // above a tenth
  const MotionWords words = words_of(motion, two_nodes());
  EXPECT_EQ(words.node, "node 12");
  EXPECT_EQ(words.place, " at (1, -2.5, 3) m");
  EXPECT_EQ(words.directions, "z, ry");
}

TEST(MotionWords, PlaceIsLeftOutWhereItIsUnknown) {
  std::vector<DofLabel> dofs = two_nodes();
  dofs[3].x_m.y() = std::numeric_limits<double>::quiet_NaN();
  const MotionWords words = words_of(Eigen::VectorXd::Unit(12, 3), dofs);
  EXPECT_EQ(words.node, "node 7");
  EXPECT_EQ(words.place, "");
  EXPECT_EQ(words.directions, "rx");
}

// Oracle: K = [[2, -1], [-1, 2]] with a unit diagonal is softest in (1, 1). With the diagonal (1, 100) of a chain of springs to
// the ground the second unknown is softest.
TEST(MotionWords, SoftestMotionIsTheLowestMode) {
  Eigen::Matrix2d k;
  k << 2.0, 0.0, -1.0, 2.0;
  linalg::Cholesky factor;
  ASSERT_TRUE(factor.factorize(k.sparseView()).converged);
  const Eigen::VectorXd soft = softest_motion(factor, Eigen::Vector2d::Ones(), 30);
  EXPECT_LT((soft - Eigen::Vector2d::Ones()).norm(), 1e-12);
  k << 5.0, 0.0, 0.0, 5.0;
  ASSERT_TRUE(factor.factorize(k.sparseView()).converged);
  const Eigen::VectorXd second = softest_motion(factor, Eigen::Vector2d(1.0, 100.0), 10);
  EXPECT_LT((second - Eigen::Vector2d::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace twindeck::fe
