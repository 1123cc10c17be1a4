// An M-orthonormal basis. Oracles: its properties (Q'MQ = 1, W = Q R, orthogonality) and Pythagoras.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "linalg/block_lanczos.hpp"

namespace twindeck::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd normal_block(Index rows, Index columns, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::Zero(rows, columns).unaryExpr([&](double) { return normal(random); });
}

/// A full, positive definite mass.
MatrixXd full_mass(Index n) {
  const MatrixXd root = normal_block(n, n, 3);
  return root * root.transpose() / static_cast<double>(n) + MatrixXd::Identity(n, n);
}

MatrixXd nothing(Index columns) { return MatrixXd::Zero(1, columns); }

void expect_factors(const OrthonormalBlock& block, const MatrixXd& w, const MatrixXd& mass, double rounding) {
  const Index m = block.q.cols();
  EXPECT_LT((block.q.transpose() * mass * block.q - MatrixXd::Identity(m, m)).norm(), rounding);
  EXPECT_LT((block.mass_q - mass * block.q).norm(), rounding * block.mass_q.norm());
  EXPECT_LT((block.q * block.r - w).norm(), 1e-12 * w.norm());
}

TEST(Orthonormalise, FactorsABlock) {
  const MatrixXd mass = full_mass(20), w = 7.0 * normal_block(20, 4, 1);
  const OrthonormalBlock block = orthonormalise(w, mass * w, nothing(4));
  ASSERT_EQ(block.q.cols(), 4);
  expect_factors(block, w, mass, 1e-12);
}

// Columns of sizes 1 to 1e-5 that lie near each other: the second pass mends what the squared condition costs the first.
TEST(Orthonormalise, FactorsAnIllConditionedBlock) {
  const MatrixXd mass = full_mass(20);
  MatrixXd w = normal_block(20, 3, 1);
  w.col(1) = w.col(0) + 1e-5 * w.col(1);
  w.col(2) *= 1e-5;
  const OrthonormalBlock block = orthonormalise(w, mass * w, nothing(3));
  ASSERT_EQ(block.q.cols(), 3);
  expect_factors(block, w, mass, 1e-10);  // 1e-16 times the condition of 1e5; one pass alone leaves its square
}

TEST(Orthonormalise, DropsDependentColumns) {
  const MatrixXd mass = full_mass(20);
  MatrixXd w = normal_block(20, 4, 1);
  w.col(2) = 2.0 * w.col(0) - w.col(1);
  w.col(3).setZero();
  const OrthonormalBlock block = orthonormalise(w, mass * w, nothing(4));
  ASSERT_EQ(block.q.cols(), 2);
  ASSERT_EQ(block.r.rows(), 2);
  ASSERT_EQ(block.r.cols(), 4);
  EXPECT_LT((block.q * block.r - w).norm(), 1e-7);  // a Gram matrix sees directions down to 1e-7 of the largest
  EXPECT_EQ(orthonormalise(MatrixXd::Zero(20, 2), MatrixXd::Zero(20, 2), nothing(2)).q.cols(), 0);
}

// What is left below 1e-11 of what was removed is rounding; what is left above it is kept.
TEST(Orthonormalise, DropsWhatOnlyRoundingLeft) {
  const MatrixXd mass = full_mass(20);
  const MatrixXd w = normal_block(20, 1, 1), removed = MatrixXd::Constant(1, 1, 1.0);
  const double norm = std::sqrt(w.col(0).dot(mass * w.col(0)));
  for (const double left : {1e-12, 1e-10}) {
    const MatrixXd small = left / norm * w;
    EXPECT_EQ(orthonormalise(small, mass * small, removed).q.cols(), left > 1e-11 ? 1 : 0) << left;
  }
}

struct Filled {
  MatrixXd mass = full_mass(30);
  KrylovBasis basis{30, 4};

  Filled() {
    const MatrixXd w = normal_block(30, 4, 1);
    basis.append(orthonormalise(w, mass * w, nothing(4)));
  }
};

TEST(KrylovBasis, TakesOffWhatABlockHasInCommonWithIt) {
  const Filled filled;
  const MatrixXd before = normal_block(30, 3, 2);
  MatrixXd w = before;
  const MatrixXd common = filled.basis.remove_from(w, 0);
  ASSERT_EQ(common.rows(), 4);
  EXPECT_LT((filled.basis.v.leftCols(4).transpose() * filled.mass * w).norm(), 1e-13);
  EXPECT_LT((filled.basis.v.leftCols(4) * common + w - before).norm(), 1e-12);
  // Pythagoras in the norm of M.
  EXPECT_NEAR((before.transpose() * filled.mass * before).trace(),
              common.squaredNorm() + (w.transpose() * filled.mass * w).trace(), 1e-9);
}

// The same from a later column: the rest is taken off by the second pass.
TEST(KrylovBasis, TakesOffAllFromALaterColumnToo) {
  const Filled filled;
  MatrixXd all = normal_block(30, 2, 2), near = all;
  const MatrixXd from_all = filled.basis.remove_from(all, 0), from_near = filled.basis.remove_from(near, 3);
  EXPECT_LT((all - near).norm(), 1e-12);
  EXPECT_LT((from_all - from_near).norm(), 1e-12);
}

TEST(KrylovBasis, GrowsBeyondItsCapacity) {
  Filled filled;
  MatrixXd w = normal_block(30, 3, 2);
  const MatrixXd common = filled.basis.remove_from(w, 0), kept = filled.basis.v.leftCols(4);
  MatrixXd mass_w = filled.mass * w;
  filled.basis.append(orthonormalise(std::move(w), std::move(mass_w), common));
  ASSERT_EQ(filled.basis.size, 7);
  const MatrixXd v = filled.basis.v.leftCols(7);
  EXPECT_EQ(v.leftCols(4), kept);
  EXPECT_LT((v.transpose() * filled.mass * v - MatrixXd::Identity(7, 7)).norm(), 1e-12);
  EXPECT_LT((filled.basis.mass_v.leftCols(7) - filled.mass * v).norm(), 1e-11);
}

}  // namespace
}  // namespace twindeck::linalg
