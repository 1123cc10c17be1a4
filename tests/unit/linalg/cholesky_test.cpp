#include "linalg/cholesky.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "linalg/lane_kernels.hpp"

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

// Oracles: the residual; and the same column solved alone, to the last bit, however many are solved at once.
TEST(Cholesky, SolvesAnyNumberOfColumnsAlike) {
  const SparseMatrix a = cube(14);
  Cholesky factor;
  ASSERT_TRUE(factor.factorize(a).converged);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(a.rows(), 37);
  const Eigen::MatrixXd all = factor.solve(b);
  EXPECT_LT((a.selfadjointView<Eigen::Lower>() * all - b).norm(), 1e-12 * b.norm());
  for (const Eigen::Index count : {1, 3, 4, 5, 8, 9, 16, 21, 30}) {
    EXPECT_EQ((factor.solve(b.leftCols(count)) - all.leftCols(count)).cwiseAbs().maxCoeff(), 0.0) << count << " columns";
  }
}

// Oracle: the definition, L y = b and Lᵀ x = y with L as a dense matrix; each instruction set that this machine has. Two
// blocks: of thirteen columns with rows below, whose remainders by 8, 4, 2 and 1 all occur, and of nine.
TEST(SupernodalSolve, EveryInstructionSetSolvesWithBothTriangles) {
  using twindeck::linalg::SupernodalFactor;
  using twindeck::linalg::LaneKernels;
  constexpr int n = 22, wide = 13;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = j + 1; i < n; ++i) {
      if (j >= wide || i < wide || i % 2 == 0) l(i, j) = number(random);
    }
    l(j, j) = 3.0 + number(random);
  }
  const std::vector<int> first = {0, wide, n};
  std::vector<int> rows, row_start = {0}, value_start = {0};
  std::vector<double> values;
  for (int s = 0; s < 2; ++s) {
    std::vector<int> mine;
    for (int i = first[static_cast<std::size_t>(s)]; i < n; ++i)
      if (s == 1 || i < wide || i % 2 == 0) mine.push_back(i);
    for (int j = first[static_cast<std::size_t>(s)]; j < first[static_cast<std::size_t>(s) + 1]; ++j)
      for (const int i : mine) values.push_back(l(i, j));
    rows.insert(rows.end(), mine.begin(), mine.end());
    row_start.push_back(static_cast<int>(rows.size()));
    value_start.push_back(static_cast<int>(values.size()));
  }
  const SupernodalFactor factor{n, 2, first.data(), row_start.data(), value_start.data(), rows.data(), values.data()};
  std::vector<LaneKernels> sets = {twindeck::linalg::plain_kernels(), twindeck::linalg::lane_kernels()};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets.push_back(twindeck::linalg::avx2_kernels());
#endif
  for (const LaneKernels& set : sets) {
    for (const auto& [width, sweep] : {std::pair(4, set.sweep_4), std::pair(8, set.sweep_8), std::pair(16, set.sweep_16)}) {
      const Eigen::MatrixXd b = Eigen::MatrixXd::Random(width, n);  // a vector a row
      Eigen::MatrixXd y = b;
      sweep(factor, y.data());
      EXPECT_LT((l * (l.transpose() * y.transpose()) - b.transpose()).norm(), 1e-10 * b.norm()) << width << " vectors";
    }
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
