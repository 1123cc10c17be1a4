#include "linalg/cholesky.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using twindeck::linalg::Cholesky;
using twindeck::linalg::SparseMatrix;

/// Lower triangle of the five-point Laplacian on an m × m grid plus `add` on the diagonal.
SparseMatrix grid(int m, double add) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) {
      const int row = i * m + j;
      entries.emplace_back(row, row, 4.0 + add);
      if (j > 0) entries.emplace_back(row, row - 1, -1.0);
      if (i > 0) entries.emplace_back(row, row - m, -1.0);
    }
  }
  SparseMatrix a(m * m, m * m);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

// Oracle: the residual of the solution, for a factor that CHOLMOD holds simplicially (small) and supernodally (large), and
// again after new values on the same pattern.
TEST(Cholesky, SolvesWithOneSymbolicFactorisation) {
  for (const int m : {5, 60}) {
    Cholesky factor;
    for (const double add : {0.0, 3.0}) {
      const SparseMatrix a = grid(m, add);
      ASSERT_TRUE(factor.factorize(a).converged);
      const Eigen::MatrixXd b = Eigen::MatrixXd::Random(m * m, 7);
      const Eigen::MatrixXd x = factor.solve(b);
      EXPECT_LT((a.selfadjointView<Eigen::Lower>() * x - b).norm(), 1e-12 * b.norm() * m * m);
    }
  }
}

/// Lower triangle of the seven-point Laplacian on an m × m × m grid: dense enough in its factor to be kept in blocks.
SparseMatrix cube(int m) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < m * m * m; ++row) {
    entries.emplace_back(row, row, 6.5);
    for (const int step : {1, m, m * m}) {
      if (row / step % m > 0) entries.emplace_back(row, row - step, -1.0);
    }
  }
  SparseMatrix a(m * m * m, m * m * m);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

// Oracles: the residual; and the same column solved beside fewer others.
TEST(Cholesky, SolvesAnyNumberOfColumnsAlike) {
  const SparseMatrix a = cube(14);
  Cholesky factor;
  ASSERT_TRUE(factor.factorize(a).converged);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.rows(), 37);
  const Eigen::MatrixXd all = factor.solve(b);
  EXPECT_LT((a.selfadjointView<Eigen::Lower>() * all - b).norm(), 1e-12 * b.norm());
  for (const Eigen::Index count : {1, 3, 4, 5, 8, 9, 16, 21, 30}) {
    EXPECT_LT((factor.solve(b.leftCols(count)) - all.leftCols(count)).norm(), 1e-13 * all.norm()) << count << " columns";
  }
}

// Oracle: by construction. A changed pattern must not be solved with the old ordering.
TEST(Cholesky, NoticesAnotherPattern) {
  Cholesky factor;
  ASSERT_TRUE(factor.factorize(grid(8, 0.0)).converged);
  SparseMatrix diagonal(64, 64);
  diagonal.setIdentity();
  ASSERT_TRUE(factor.factorize(diagonal).converged);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(64, 1.0, 2.0);
  EXPECT_LT((factor.solve(b) - b).norm(), 1e-14);
}

// Oracle: by construction. Row 5 is the only one without stiffness, so it is the row that must be named, whatever the ordering.
TEST(Cholesky, NamesTheRowThatBreaksDown) {
  for (const int m : {4, 50}) {
    SparseMatrix a = grid(m, 1.0);
    for (int j = 0; j < a.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator it(a, j); it; ++it) {
        if (it.row() == 5 || j == 5) it.valueRef() = 0.0;
      }
    }
    Cholesky factor;
    const twindeck::Status status = factor.factorize(a);
    EXPECT_FALSE(status.converged);
    EXPECT_EQ(factor.failed_column(), 5);
    EXPECT_NE(status.message.find("row 6"), std::string::npos) << status.message;
    // The same object still works with a sound matrix.
    EXPECT_TRUE(factor.factorize(grid(m, 1.0)).converged);
    EXPECT_EQ(factor.failed_column(), -1);
  }
}

// Oracle: a chain of springs that nothing holds is singular (rigid translation), and a matrix with a negative eigenvalue is
// refused.
TEST(Cholesky, RefusesFreeAndIndefinite) {
  const int n = 400;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, i == 0 || i == n - 1 ? 0.7 : 1.4);
    if (i > 0) entries.emplace_back(i, i - 1, -0.7);
  }
  SparseMatrix chain(n, n);
  chain.setFromTriplets(entries.begin(), entries.end());
  Cholesky factor;
  EXPECT_FALSE(factor.factorize(chain).converged);
  EXPECT_FALSE(factor.factorize(grid(6, -4.0)).converged);
}

}  // namespace
