// Oracle: the same matrix written out whole.
#include "diagnosis/reduction/compact_matrix.hpp"

#include <gtest/gtest.h>

namespace twindeck::tests {
namespace {

using diagnosis::CompactMatrix;
using diagnosis::Symmetric;
using Eigen::MatrixXd;

/// A spring between dofs 1 and 4 of six, with a third dof beside them, so that no two entries are alike.
MatrixXd spring_of_six() {
  MatrixXd s = MatrixXd::Zero(6, 6);
  s(1, 1) = 7.0;
  s(4, 4) = 5.0;
  s(3, 3) = 2.0;
  s(1, 4) = s(4, 1) = -3.0;
  return s;
}

TEST(CompactMatrix, HoldsTheDofsThatItTouches) {
  const CompactMatrix compact(Symmetric(spring_of_six().sparseView()));
  EXPECT_EQ(compact.size(), 6);
  EXPECT_EQ(compact.dofs(), (std::vector<int>{1, 3, 4}));
  EXPECT_EQ(compact.nonZeros(), 5);
  Eigen::Matrix3d block;
  block << 7.0, 0.0, -3.0, 0.0, 2.0, 0.0, -3.0, 0.0, 5.0;
  EXPECT_EQ(MatrixXd(compact.block()), MatrixXd(block));
}

TEST(CompactMatrix, BecomesTheWholeAgain) {
  EXPECT_EQ(MatrixXd(CompactMatrix(Symmetric(spring_of_six().sparseView())).whole()), spring_of_six());
}

TEST(CompactMatrix, MultipliesAsTheWholeDoes) {
  // Small whole numbers: their products and sums are exact.
  const CompactMatrix compact(Symmetric(spring_of_six().sparseView()));
  MatrixXd x(6, 2);
  x << 1, -2, 3, 4, -5, 6, 7, -8, 9, 10, 11, 12;
  EXPECT_EQ(compact * x, MatrixXd(spring_of_six() * x));
  EXPECT_EQ(compact.times(-0.5, x), MatrixXd(-0.5 * spring_of_six() * x));
}

TEST(CompactMatrix, OfNothingIsEmpty) {
  const CompactMatrix nothing;
  EXPECT_EQ(nothing.size(), 0);
  EXPECT_EQ(nothing.nonZeros(), 0);
  EXPECT_EQ(nothing.whole().size(), 0);
  const CompactMatrix zeros(Symmetric(4, 4));
  EXPECT_EQ(zeros.size(), 4);
  EXPECT_TRUE(zeros.dofs().empty());
  EXPECT_EQ(zeros * MatrixXd::Ones(4, 1), MatrixXd::Zero(4, 1));
  EXPECT_EQ(zeros.whole().nonZeros(), 0);
}

TEST(CompactMatrix, CopiesShareTheBlock) {
  const CompactMatrix one(Symmetric(spring_of_six().sparseView()));
  const CompactMatrix other = one;  // NOLINT(performance-unnecessary-copy-initialization): what is tested
  EXPECT_EQ(&one.block(), &other.block());
}

}  // namespace
}  // namespace twindeck::tests
