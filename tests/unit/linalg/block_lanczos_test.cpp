// Largest eigenvalues of A^-1 M by block Lanczos. Oracles: diagonal matrices, whose pairs are known; repeated eigenvalues; a
// mass of low rank; the residual of each pair.
#include "linalg/block_lanczos.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace twindeck::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The operator of diagonal A and M: eigenvalues m_i / a_i, vectors e_i.
SelfAdjointOperator diagonal_operator(const VectorXd& a, const VectorXd& m) {
  return {[m](const MatrixXd& x) -> MatrixXd { return m.asDiagonal() * x; },
          [a](const MatrixXd& y) -> MatrixXd { return a.cwiseInverse().asDiagonal() * y; }};
}

/// Blocks of random numbers, in the range of the operator.
std::function<MatrixXd(int)> random_start(const SelfAdjointOperator& op, Index n, Index width) {
  return [op, n, width](int draw) -> MatrixXd {
    std::mt19937_64 random(static_cast<unsigned>(draw) + 5);
    std::normal_distribution<double> normal;
    const MatrixXd block = MatrixXd::Zero(n, width).unaryExpr([&](double) { return normal(random); });
    return op.from_mass(op.times_mass(block));
  };
}

VectorXd rayleigh(const SelfAdjointOperator& op, const MatrixXd& x) {
  const MatrixXd mass_x = op.times_mass(x);
  return mass_x.cwiseProduct(op.from_mass(mass_x)).colwise().sum();
}

void expect_pairs(const SelfAdjointOperator& op, const MatrixXd& x, const VectorXd& values) {
  ASSERT_EQ(x.cols(), values.size());
  EXPECT_LT((x.transpose() * op.times_mass(x) - MatrixXd::Identity(x.cols(), x.cols())).norm(), 1e-11);
  EXPECT_LT((rayleigh(op, x) - values).cwiseQuotient(values).cwiseAbs().maxCoeff(), 1e-12);
  // A residual of 1e-9 is the method's own tolerance; the norm of x is at most 1 / sqrt(least mass).
  const MatrixXd residual = op.from_mass(op.times_mass(x)) - x * values.asDiagonal();
  for (Index i = 0; i < x.cols(); ++i) EXPECT_LT(residual.col(i).norm(), 2e-9 * values(i)) << i;
}

TEST(BlockLanczos, FindsTheLargestPairsOfADiagonalOperator) {
  const Index n = 400;
  const VectorXd a = VectorXd::LinSpaced(n, 1.0, 400.0).cwiseAbs2(), m = VectorXd::LinSpaced(n, 1.0, 3.0);
  const SelfAdjointOperator op = diagonal_operator(a, m);
  const BlockLanczosResult found = block_lanczos(op, random_start(op, n, 3), 7);
  EXPECT_EQ(found.converged, 7);
  EXPECT_GT(found.operations, 7);
  expect_pairs(op, found.vectors, m.cwiseQuotient(a).head(7));  // they fall with i
}

// Slow convergence, so that the basis is restarted: neighbours differ by 1/1000, and 40 columns of 600 have room.
TEST(BlockLanczos, ConvergesThroughRestarts) {
  const Index n = 600;
  const VectorXd a = VectorXd::LinSpaced(n, 1.0, 1.6), m = VectorXd::Ones(n);
  const SelfAdjointOperator op = diagonal_operator(a, m);
  const BlockLanczosResult found = block_lanczos(op, random_start(op, n, 2), 5);
  ASSERT_EQ(found.converged, 5);
  EXPECT_GT(found.operations, 2 * (5 + 6 * 2));  // more than one basis
  expect_pairs(op, found.vectors, a.head(5).cwiseInverse());
}

// Three copies of each eigenvalue and a block of three: all copies are found.
TEST(BlockLanczos, FindsAllCopiesWithinItsWidth) {
  const Index n = 90;
  VectorXd a(n);
  for (Index i = 0; i < n; ++i) a(i) = std::pow(1.0 + static_cast<double>(i / 3), 2);
  const SelfAdjointOperator op = diagonal_operator(a, VectorXd::Ones(n));
  const BlockLanczosResult found = block_lanczos(op, random_start(op, n, 3), 6);
  ASSERT_EQ(found.converged, 6);
  expect_pairs(op, found.vectors, (VectorXd(6) << 1, 1, 1, 0.25, 0.25, 0.25).finished());
}

// The identity is spent after one vector; further starts find the other copies.
TEST(BlockLanczos, StartsAgainWhereTheBasisIsInvariant) {
  const Index n = 12;
  const SelfAdjointOperator op = diagonal_operator(VectorXd::Constant(n, 4.0), VectorXd::Ones(n));
  const BlockLanczosResult found = block_lanczos(op, random_start(op, n, 1), 5);
  ASSERT_EQ(found.converged, 5);
  expect_pairs(op, found.vectors, VectorXd::Constant(5, 0.25));
}

// A mass of rank 3 has three pairs, however many are asked for.
TEST(BlockLanczos, FindsNoMorePairsThanTheMassHas) {
  const Index n = 30;
  VectorXd m = VectorXd::Zero(n);
  m(4) = 2.0, m(11) = 3.0, m(20) = 5.0;
  const SelfAdjointOperator op = diagonal_operator(VectorXd::Ones(n), m);
  const BlockLanczosResult found = block_lanczos(op, random_start(op, n, 4), 6);
  EXPECT_EQ(found.converged, 3);
  expect_pairs(op, found.vectors, Eigen::Vector3d(5.0, 3.0, 2.0));
}

// As many pairs as there are dofs, and one more than that.
TEST(BlockLanczos, FindsAllPairsOfASmallOperator) {
  const VectorXd a = VectorXd::LinSpaced(6, 1.0, 6.0);
  const SelfAdjointOperator op = diagonal_operator(a, VectorXd::Ones(6));
  for (const int wanted : {6, 7}) {
    const BlockLanczosResult found = block_lanczos(op, random_start(op, 6, 2), wanted);
    EXPECT_EQ(found.converged, 6) << wanted;
    expect_pairs(op, found.vectors, a.cwiseInverse());
  }
}

TEST(BlockLanczos, FindsNothingFromAnEmptyStart) {
  const SelfAdjointOperator op = diagonal_operator(VectorXd::Ones(5), VectorXd::Ones(5));
  const BlockLanczosResult found = block_lanczos(
      op, [](int) -> MatrixXd { return MatrixXd::Zero(5, 2); }, 1);
  EXPECT_EQ(found.converged, 0);
  EXPECT_EQ(found.vectors.size(), 0);
}

}  // namespace
}  // namespace twindeck::linalg
