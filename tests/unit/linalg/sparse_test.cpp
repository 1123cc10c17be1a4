/// Oracle: the same product of dense matrices.
#include "linalg/sparse.hpp"

#include <gtest/gtest.h>

namespace twindeck::linalg {
namespace {

using Eigen::MatrixXd;

TEST(SymmetricProduct, IsThatOfTheWholeMatrixForAnyNumberOfColumns) {
  const MatrixXd whole{{4.0, 0.0, 1.5}, {0.0, 2.0, -0.7}, {1.5, -0.7, 3.0}};
  SparseMatrix lower = MatrixXd(whole.triangularView<Eigen::Lower>()).sparseView();
  for (const int columns : {0, 1, 3, 4, 6}) {
    MatrixXd x(3, columns);
    for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = 0.3 * static_cast<double>(k) - 1.1;
    const MatrixXd y = symmetric_product(lower, x);
    ASSERT_EQ(y.cols(), columns);
    for (int j = 0; j < columns; ++j) EXPECT_LT((y.col(j) - whole * x.col(j)).norm(), 1e-14) << j << " of " << columns;
  }
}

TEST(SymmetricProduct, TakesAPartOfAMatrix) {
  const MatrixXd whole{{4.0, 1.0}, {1.0, 2.0}};
  const SparseMatrix lower = MatrixXd(whole.triangularView<Eigen::Lower>()).sparseView();
  const MatrixXd larger{{1.0, 9.0, 3.0}, {2.0, 9.0, 4.0}, {9.0, 9.0, 9.0}};
  const MatrixXd part = larger.topRows(2);
  EXPECT_LT((symmetric_product(lower, larger.topRows(2)) - whole * part).norm(), 1e-14);
}

TEST(WithoutZeros, KeepsWhatCounts) {
  SparseMatrix a(2, 2);
  a.insert(0, 0) = 1.0;
  a.insert(1, 0) = 0.0;
  a.insert(1, 1) = 2.0;
  a.makeCompressed();
  const SparseMatrix kept = without_zeros(a);
  EXPECT_EQ(kept.nonZeros(), 2);
  EXPECT_EQ(MatrixXd(kept), MatrixXd(a));
}

// Oracle: Eigen's product, to the last bit: both add column by column. Nothing to multiply gives zeros.
TEST(SparseProduct, OfManyColumnsIsThatOfEach) {
  SparseMatrix a(3, 4);
  for (const auto& [i, j, value] : {std::tuple{0, 1, 0.1}, {2, 1, -3.0}, {1, 0, 1.0 / 3.0}, {2, 3, 7.0}, {0, 3, 1e-9}})
    a.insert(i, j) = value;
  for (const int columns : {0, 1, 3, 4, 9}) {
    const MatrixXd x = MatrixXd::Random(4, columns);
    EXPECT_EQ(product(a, x), MatrixXd(a * x)) << columns;
  }
  EXPECT_EQ(product(SparseMatrix(3, 0), MatrixXd(0, 2)), MatrixXd(MatrixXd::Zero(3, 2)));
}

}  // namespace
}  // namespace twindeck::linalg
