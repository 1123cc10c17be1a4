// Dense kernels. Oracle: the definitions, by products that are written out.
#include "linalg/dense.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>

namespace twindeck::tests {
namespace {

using Eigen::MatrixXd;

MatrixXd numbers(Eigen::Index rows, Eigen::Index columns) {
  MatrixXd a(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) a(i, j) = std::sin(1.0 + 3.7 * static_cast<double>(i) + 1.3 * static_cast<double>(i * j));
  return a;
}

TEST(Dense, ALowerFactorIsSolvedByItsLowerTriangleAlone) {
  MatrixXd lower = numbers(40, 40);
  lower.diagonal().array() += 5.0;
  const MatrixXd x = numbers(40, 7);
  const MatrixXd triangle = lower.triangularView<Eigen::Lower>();
  EXPECT_LT((linalg::lower_solve(lower, triangle.lazyProduct(x)) - x).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((linalg::lower_solve(lower.topLeftCorner(12, 12), triangle.topLeftCorner(12, 12).lazyProduct(x.topRows(12))) - x.topRows(12))
                .cwiseAbs()
                .maxCoeff(),
            1e-11);
  EXPECT_EQ(linalg::lower_solve(lower, MatrixXd(40, 0)).cols(), 0);
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

}  // namespace
}  // namespace twindeck::tests
