// Dense kernels. Oracle: the definitions, by products that are written out.
#include "linalg/dense.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace twindeck::tests {
namespace {

using Eigen::MatrixXd;

MatrixXd numbers(Eigen::Index rows, Eigen::Index columns) {
  MatrixXd a(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i)
      a(i, j) = std::sin(1.0 + 3.7 * static_cast<double>(i) + 1.3 * static_cast<double>(i * j));
  return a;
}

TEST(Dense, ASquareHasBothTriangles) {
  const MatrixXd a = numbers(33, 9);
  EXPECT_LT((linalg::square(a.topRows(20)) - a.topRows(20).lazyProduct(a.topRows(20).transpose())).cwiseAbs().maxCoeff(),
            1e-12);
  EXPECT_TRUE(linalg::square(MatrixXd(4, 0)).isZero(0.0));
}

TEST(Dense, ALowerFactorIsSolvedByItsLowerTriangleAlone) {
  MatrixXd lower = numbers(40, 40);
  lower.diagonal().array() += 5.0;
  const MatrixXd x = numbers(40, 7);
  const MatrixXd triangle = lower.triangularView<Eigen::Lower>();
  EXPECT_LT((linalg::lower_solve(lower, triangle.lazyProduct(x)) - x).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((linalg::lower_solve(lower.topLeftCorner(12, 12), triangle.topLeftCorner(12, 12).lazyProduct(x.topRows(12))) -
             x.topRows(12))
                .cwiseAbs()
                .maxCoeff(),
            1e-11);
  EXPECT_EQ(linalg::lower_solve(lower, MatrixXd(40, 0)).cols(), 0);
  const MatrixXd upper = triangle.transpose();
  EXPECT_LT((linalg::lower_solve(lower, upper.lazyProduct(x), true) - x).cwiseAbs().maxCoeff(), 1e-10);
}

// Oracle: the closed form of the chain, eigenvalues 2 - 2 cos(k pi / (n + 1)) with vectors sin(i k pi / (n + 1)).
TEST(Dense, LeadingEigenpairsOfTheChain) {
  const Eigen::Index n = 30, wanted = 4;
  MatrixXd chain = MatrixXd::Zero(n, n);
  chain.diagonal().setConstant(2.0);
  chain.diagonal(-1).setConstant(-1.0);  // the lower triangle alone
  const linalg::LeadingEigenpairs found = linalg::leading_eigenpairs(chain, wanted);
  ASSERT_EQ(found.values.size(), wanted);
  for (Eigen::Index j = 0; j < wanted; ++j) {
    const double angle = static_cast<double>(n - j) * std::numbers::pi / static_cast<double>(n + 1);
    EXPECT_NEAR(found.values[j], 2.0 - 2.0 * std::cos(angle), 1e-13);
    const Eigen::VectorXd vector =
        Eigen::VectorXd::LinSpaced(n, 1.0, static_cast<double>(n)).unaryExpr([&](double i) { return std::sin(i * angle); });
    EXPECT_NEAR(std::abs(found.vectors.col(j).dot(vector.normalized())), 1.0, 1e-12);
  }
}

// Oracle: matrices put together from reflections and singular values that are stated, wide and high.
TEST(Dense, AThinSingularValueDecompositionIsThatOfItsParts) {
  const auto reflection = [](const Eigen::VectorXd& v) -> MatrixXd {
    return MatrixXd::Identity(v.size(), v.size()) - 2.0 / v.squaredNorm() * v * v.transpose();
  };
  const MatrixXd left = reflection(numbers(12, 1)), right = reflection(numbers(5, 1).array() + 2.0);
  const Eigen::VectorXd stated = (Eigen::VectorXd(5) << 9.0, 4.0, 1.0, 0.5, 0.01).finished();
  const MatrixXd high = left.leftCols(5) * stated.asDiagonal() * right.transpose();
  for (const MatrixXd& a : {high, MatrixXd(high.transpose())}) {
    const linalg::ThinSvd svd = linalg::thin_svd(a);
    EXPECT_LT((svd.values - stated).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((svd.u * svd.values.asDiagonal() * svd.vt - a).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((svd.u.transpose() * svd.u - MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(Dense, AFactorTimesItselfIsTheMatrixAndThereIsNoneOfAnIndefiniteOne) {
  const MatrixXd a = numbers(30, 30);
  MatrixXd positive = a.lazyProduct(a.transpose());
  positive.diagonal().array() += 1.0;
  const MatrixXd l = linalg::cholesky_factor(positive);
  EXPECT_LT((l.lazyProduct(l.transpose()) - positive).cwiseAbs().maxCoeff(), 1e-12 * positive.trace());
  positive(7, 7) = -1.0;
  EXPECT_EQ(linalg::cholesky_factor(positive).size(), 0);
}

TEST(Dense, AComplexSystemIsSolvedAndASingularOneIsNoNumber) {
  Eigen::MatrixXcd a(25, 25);
  a.real() = numbers(25, 25);
  a.imag() = numbers(25, 25).transpose();
  const Eigen::MatrixXcd x = numbers(25, 3) * std::complex<double>(0.3, -1.1);
  EXPECT_LT((linalg::solve(a, a.lazyProduct(x)) - x).cwiseAbs().maxCoeff(), 1e-9);
  a.col(4).setZero();
  EXPECT_FALSE(linalg::solve(a, x).allFinite());
  EXPECT_EQ(linalg::solve(a, Eigen::MatrixXcd(25, 0)).cols(), 0);
}

TEST(Dense, ARealSystemToo) {
  MatrixXd a = numbers(25, 25);
  const MatrixXd x = numbers(25, 3);
  EXPECT_LT((linalg::solve(a, a.lazyProduct(x)) - x).cwiseAbs().maxCoeff(), 1e-9);
  a.col(4).setZero();
  EXPECT_FALSE(linalg::solve(a, x).allFinite());
}

// Oracle: the companion matrix of a polynomial has its roots as eigenvalues.
TEST(Dense, EigenpairsAboveAValueAreTheLeadingOnes) {
  const MatrixXd half = numbers(20, 20);
  const MatrixXd a = half + half.transpose();
  const linalg::LeadingEigenpairs all = linalg::leading_eigenpairs(a, 20);
  const linalg::LeadingEigenpairs some = linalg::eigenpairs_above(a, 0.5 * (all.values[4] + all.values[5]));
  ASSERT_EQ(some.values.size(), 5);
  EXPECT_LT((some.values - all.values.head(5)).norm(), 1e-12 * all.values[0]);
  EXPECT_LT((a * some.vectors - some.vectors * some.values.asDiagonal()).norm(), 1e-11 * all.values[0]);
  EXPECT_LT((some.vectors.transpose() * some.vectors - MatrixXd::Identity(5, 5)).norm(), 1e-11);
  EXPECT_EQ(linalg::eigenpairs_above(a, 1.01 * all.values[0]).values.size(), 0);
  EXPECT_EQ(linalg::eigenpairs_above(a, 100.0 * all.values[0]).values.size(), 0);
}

TEST(Dense, EigenvaluesOfACompanionMatrixAreTheRoots) {
  const std::vector<std::complex<double>> roots = {{-0.1, 2.0}, {-0.1, -2.0}, {-3.0, 0.0}, {0.4, 0.7}, {0.4, -0.7}};
  std::vector<std::complex<double>> polynomial = {1.0};  // highest power first
  for (const auto root : roots) {
    polynomial.emplace_back(0.0);
    for (std::size_t i = polynomial.size() - 1; i > 0; --i) polynomial[i] -= root * polynomial[i - 1];
  }
  MatrixXd companion = MatrixXd::Zero(5, 5);
  companion.bottomLeftCorner(4, 4).setIdentity();
  for (int i = 0; i < 5; ++i) companion(0, i) = -polynomial[static_cast<std::size_t>(i) + 1].real();
  const Eigen::VectorXcd found = linalg::unsymmetric_eigen(companion, false).values;
  for (const auto root : roots) EXPECT_LT((found.array() - root).abs().minCoeff(), 1e-12);
  EXPECT_FALSE(linalg::unsymmetric_eigen(MatrixXd::Constant(3, 3, std::nan("")), false).values.allFinite());
}

// Oracle: A v = lambda v, and the values of the routine without vectors.
TEST(UnsymmetricEigen, VectorsAreThoseOfTheValues) {
  std::srand(5);
  const MatrixXd a = MatrixXd::Random(9, 9);  // with conjugate pairs and real values
  const linalg::UnsymmetricEigen found = linalg::unsymmetric_eigen(a);
  EXPECT_LT((a.cast<std::complex<double>>() * found.vectors - found.vectors * found.values.asDiagonal()).norm(), 1e-12);
  for (Eigen::Index j = 0; j < 9; ++j) EXPECT_NEAR(found.vectors.col(j).norm(), 1.0, 1e-12);
  const Eigen::VectorXcd alone = linalg::unsymmetric_eigen(a, false).values;
  for (const auto value : found.values) EXPECT_LT((alone.array() - value).abs().minCoeff(), 1e-12);
  EXPECT_FALSE(linalg::unsymmetric_eigen(MatrixXd::Constant(3, 3, std::nan(""))).values.allFinite());
}

}  // namespace
}  // namespace twindeck::tests
