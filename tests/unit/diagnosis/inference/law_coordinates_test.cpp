// Coordinates of which the classes of errors reach only the first ones. Oracles: chi² and determinant of the dense covariance
// of the rows.
#include "diagnosis/inference/law_coordinates.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "diagnosis/inference/one_law.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::ErrorColumns;
using diagnosis::LawSystem;
using diagnosis::OneLaw;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kRows = 60;

MatrixXd random_matrix(std::mt19937_64& random, Index rows, Index columns) {
  std::normal_distribution<double> normal;
  MatrixXd m(rows, columns);
  for (double& v : m.reshaped()) v = normal(random);
  return m;
}

/// Class 0 reaches twenty scattered rows by eight columns, class 1 all rows by three, class 2 none.
LawSystem mixed_system() {
  std::mt19937_64 random(5);
  LawSystem out;
  const MatrixXd root = random_matrix(random, kRows, kRows);
  out.sigma = root * root.transpose() + 0.1 * MatrixXd::Identity(kRows, kRows);
  MatrixXd some = MatrixXd::Zero(kRows, 8);
  for (Index r = 0; r < kRows; r += 3) some.row(r) = random_matrix(random, 1, 8);
  out.classes = {ErrorColumns::of_columns(some), ErrorColumns::of_columns(random_matrix(random, kRows, 3)), {}};
  out.residual = random_matrix(random, kRows, 1);
  return out;
}

void expect_dense(const LawSystem& system, const VectorXd& tau, Index reached) {
  const OneLaw law(system);
  ASSERT_TRUE(law.coordinates().exist());
  EXPECT_EQ(law.coordinates().sigma().rows(), reached);
  const MatrixXd sigma = diagnosis::covariance_at(system, tau);
  const OneLaw::Point at = law.at(tau);
  ASSERT_TRUE(at.exists);
  const double chi_squared = system.residual.dot(sigma.ldlt().solve(system.residual));
  EXPECT_NEAR(at.whitened(law.coordinates().of(system.residual)).squaredNorm() / chi_squared, 1.0, 1e-9);
  EXPECT_NEAR(at.log_determinant, std::log(sigma.determinant()), 1e-8);
}

TEST(LawCoordinates, HoldAClassOfFewRowsAndOneOfFewColumns) {
  expect_dense(mixed_system(), Eigen::Vector3d(0.7, 2.0, 0.0), 20 + 3);
  expect_dense(mixed_system(), Eigen::Vector3d(0.0, 0.0, 0.0), 20 + 3);
}

TEST(LawCoordinates, AreNoneWithoutAClassAndAllWhereAClassReachesAllRows) {
  LawSystem system = mixed_system();
  system.classes = {ErrorColumns{}};
  expect_dense(system, VectorXd::Zero(1), 0);
  std::mt19937_64 random(6);
  system.classes = {ErrorColumns::of_columns(random_matrix(random, kRows, 30))};
  expect_dense(system, VectorXd::Constant(1, 0.4), kRows);
}

TEST(LawCoordinates, DoNotExistIfRowsWithoutAClassHaveNoVariance) {
  LawSystem system = mixed_system();
  system.sigma.row(1).setZero();
  system.sigma.col(1).setZero();
  EXPECT_FALSE(OneLaw(system).coordinates().exist());
  EXPECT_EQ(
      OneLaw(system).scored({system.residual, VectorXd::Zero(1), {}, {}, {}, {{0, 1.0}}}, VectorXd::Ones(3)).weight.size(), 0);
}

}  // namespace
}  // namespace twindeck::tests
