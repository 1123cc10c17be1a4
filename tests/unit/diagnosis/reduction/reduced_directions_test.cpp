// Oracle: V' b with the whole V.
#include <gtest/gtest.h>

#include "diagnosis/reduction/reduced_basis.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::ReducedBasis;
using diagnosis::ReducedDirections;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kDofs = 7, kCommon = 3;

/// Numbers without a pattern that an exchange of rows and columns leaves.
MatrixXd numbers(Index rows, Index columns, double phase) {
  MatrixXd out(rows, columns);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j)
      out(i, j) = std::sin(phase + 2.3 * static_cast<double>(i) + 5.1 * static_cast<double>(j));
  return out;
}

ReducedBasis::Block block(Index columns, double phase) {
  return {std::make_shared<const MatrixXd>(numbers(kDofs, columns, phase)), [=] { return numbers(kDofs, columns, phase); }};
}

class Directions : public ::testing::Test {
 protected:
  Directions() {
    basis->append({block(2, 1.0), block(1, 2.0)});
    b.insert(1, 0) = 2.0;
    b.insert(4, 0) = -1.0;
    b.insert(6, 2) = 3.0;
  }
  [[nodiscard]] MatrixXd whole() const {
    MatrixXd v(kDofs, basis->size());
    v.leftCols(kCommon) = basis->common_vectors();
    for (std::size_t g = 0; g < basis->groups().size(); ++g) {
      const auto& group = basis->groups()[g];
      v.middleCols(group.first, group.count) = *basis->vectors(static_cast<int>(g));
    }
    return v;
  }
  void expect_whole(const ReducedDirections& directions) const {
    std::vector<int> all;
    for (int k = 0; k < basis->size(); ++k) all.push_back(k);
    for (const std::vector<int>& columns :
         {all, std::vector<int>{0, 1, 2}, std::vector<int>{0, 1, 2, 5}, std::vector<int>{0, 1, 2, 5, 3, 4}}) {
      for (Index d = 0; d < 3; ++d) {
        const VectorXd expected = (whole().transpose() * b.col(d)).eval()(columns);
        EXPECT_LT((directions.part(d, columns) - expected).norm(), 1e-14) << "direction " << d;
      }
    }
  }

  std::shared_ptr<ReducedBasis> basis = std::make_shared<ReducedBasis>(numbers(kDofs, kCommon, 0.0));
  Eigen::SparseMatrix<double> b{kDofs, 3};
};

TEST_F(Directions, ArePartsOfTheWholeProduct) { expect_whole(ReducedDirections(b, basis, false)); }

TEST_F(Directions, AreTheSameOfTheGroupThatIsKept) {
  for (const int group : {0, 1}) {
    ReducedDirections directions(b, basis, false);
    directions.keep(group);
    expect_whole(directions);
  }
}

TEST_F(Directions, FollowABasisThatGrows) {
  ReducedDirections directions(b, basis, true);
  directions.follow_basis();
  expect_whole(directions);
  basis->append({block(2, 3.0)});
  directions.follow_basis();
  directions.keep(0);  // one that all states use keeps every group
  expect_whole(directions);
}

TEST_F(Directions, KnowWhichOnesCannotMove) {
  const ReducedDirections directions(b, basis, false);
  EXPECT_EQ(directions.cols(), 3);
  EXPECT_FALSE(directions.is_zero(0));
  EXPECT_TRUE(directions.is_zero(1));
  EXPECT_FALSE(directions.is_zero(2));
  EXPECT_EQ(ReducedDirections().cols(), 0);
}

}  // namespace
}  // namespace twindeck::tests
