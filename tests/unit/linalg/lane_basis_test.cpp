#include "linalg/lane_basis.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "linalg/cholesky.hpp"
#include "linalg/lane_kernels.hpp"
#include "linalg/symmetric_product.hpp"

namespace {

using Eigen::MatrixXd;
using twindeck::linalg::Cholesky;
using twindeck::linalg::LaneBasis;
using twindeck::linalg::LaneKernels;
using twindeck::linalg::SparseMatrix;
using twindeck::linalg::SymmetricProduct;

/// Largest entry of `found` that `expected` has not.
double apart(const MatrixXd& found, const MatrixXd& expected) { return (found - expected).cwiseAbs().maxCoeff(); }

/// Lower triangle of a positive definite band with a few stored zeros.
SparseMatrix band(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 5.0 + 0.01 * (i % 7));
    if (i >= 1) entries.emplace_back(i, i - 1, i % 5 == 0 ? 0.0 : -1.0);
    if (i >= 9) entries.emplace_back(i, i - 9, -0.5);
  }
  SparseMatrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

// Oracle: the same with dense matrices. Columns and rows that fill neither the last block nor the last pass.
TEST(LaneBasis, MultipliesAsDenseMatricesDo) {
  const int n = 523;
  const MatrixXd v = MatrixXd::Random(n, 11), x = MatrixXd::Random(n, 19);
  LaneBasis basis(v);
  EXPECT_EQ(basis.size(), 11);
  EXPECT_EQ(apart(basis.dense(), v), 0.0);
  EXPECT_LT(apart(basis.transposed_times(LaneBasis(x)), v.transpose() * x), 1e-11);

  const MatrixXd c = MatrixXd::Random(11, 19);
  LaneBasis less(x);
  less.subtract_product(basis, c);
  EXPECT_LT(apart(less.dense(), x - v * c), 1e-12);

  basis.append_product(LaneBasis(x), MatrixXd::Constant(19, 3, 0.5));
  MatrixXd longer(n, 14);
  longer << v, (0.5 * x.rowwise().sum()).replicate(1, 3);
  EXPECT_LT(apart(basis.dense(), longer), 1e-12);
  // Blocks that are not full, one after the other.
  EXPECT_LT(apart(basis.transposed_times(basis), longer.transpose() * longer), 1e-9);
}

// Oracle: the solutions and products of the same columns as a dense matrix; one block alone, two together, and three.
TEST(LaneBasis, IsSolvedAndMultipliedAsItsColumns) {
  const SparseMatrix a = band(3000);
  Cholesky factor;
  ASSERT_TRUE(factor.factorize(a).converged);
  const SymmetricProduct product(a);
  for (const int columns : {3, 8, 13, 21}) {
    const MatrixXd x = MatrixXd::Random(a.rows(), columns);
    const MatrixXd image = a.selfadjointView<Eigen::Lower>() * x;
    EXPECT_LT(apart(factor.solve(LaneBasis(image)).dense(), x), 1e-12) << columns;
    EXPECT_LT(apart(product.times(LaneBasis(x)).dense(), image), 1e-12) << columns;
    EXPECT_LT(apart(product.times(x), image), 1e-12) << columns;
    EXPECT_LT(apart(twindeck::linalg::symmetric_product(a, LaneBasis(x)).dense(), image), 1e-12) << columns;
  }
}

// Oracle: the definitions, with each instruction set that this machine has.
TEST(LaneKernels, AreTheSameInEveryInstructionSet) {
  std::vector<LaneKernels> sets = {twindeck::linalg::plain_kernels(), twindeck::linalg::lane_kernels()};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets.push_back(twindeck::linalg::avx2_kernels());
#endif
  const int n = 77;
  const MatrixXd a = MatrixXd::Random(8, n), b = MatrixXd::Random(8, n), c = MatrixXd::Random(8, 8);
  const SparseMatrix k = band(n);
  const twindeck::linalg::LowerTriangle triangle{n, k.outerIndexPtr(), k.innerIndexPtr(), k.valuePtr()};
  const MatrixXd whole = k.selfadjointView<Eigen::Lower>() * MatrixXd::Identity(n, n);
  for (const LaneKernels& set : sets) {
    MatrixXd inner = c, combined = b, eight = b, four = b.topRows(4);
    set.inner_8(a.data(), b.data(), n, inner.data());
    EXPECT_LT(apart(inner, c + a * b.transpose()), 1e-13);
    set.combine_8(c.data(), a.data(), n, combined.data());
    EXPECT_LT(apart(combined, b + c * a), 1e-14);
    set.multiply_8(triangle, a.data(), eight.data());
    EXPECT_LT(apart(eight, b + a * whole), 1e-14);
    const MatrixXd some = a.topRows(4);
    set.multiply_4(triangle, some.data(), four.data());
    EXPECT_LT(apart(four, b.topRows(4) + some * whole), 1e-14);
  }
}

}  // namespace
