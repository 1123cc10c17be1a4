// Oracles: matrices that are built from chosen triplets; the defining equations A v = sigma u, Aᵀ u = sigma v.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "../signal/noise.hpp"
#include "core/error.hpp"
#include "identification/state_space.hpp"

namespace twindeck::identification {
namespace {

/// Columns that are orthonormal, by a QR decomposition of noise.
Eigen::MatrixXd orthonormal(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  signal::test::Noise noise(seed);
  Eigen::MatrixXd x(rows, columns);
  for (double& value : x.reshaped()) value = noise();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(x);
  return qr.householderQ() * Eigen::MatrixXd::Identity(rows, columns);
}

void expect_signs(const LeadingSvd& svd) {
  for (Eigen::Index j = 0; j < svd.u.cols(); ++j) {
    Eigen::Index largest = 0;
    svd.u.col(j).cwiseAbs().maxCoeff(&largest);
    EXPECT_GT(svd.u(largest, j), 0.0) << j;
  }
}

// A = 3 e_2 f_1ᵀ - 5 e_1 f_2ᵀ: values 5 and 3; u has a positive leading entry, so that the minus is in v.
TEST(LeadingSvdOf, AMatrixOfTwoDyadsByHand) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 3);
  a(1, 0) = 3.0;
  a(0, 1) = -5.0;
  const LeadingSvd svd = leading_svd(a, 2);
  EXPECT_LT((svd.values - Eigen::Vector2d(5.0, 3.0)).norm(), 1e-14);
  EXPECT_LT((svd.u.col(0) - Eigen::Vector4d::Unit(0)).norm(), 1e-14);
  EXPECT_LT((svd.v.col(0) + Eigen::Vector3d::Unit(1)).norm(), 1e-14);
  EXPECT_LT((svd.u.col(1) - Eigen::Vector4d::Unit(1)).norm(), 1e-14);
  EXPECT_LT((svd.v.col(1) - Eigen::Vector3d::Unit(0)).norm(), 1e-14);
}

// Small matrices go the direct way, those with more than 400 rows and columns by squares: both hold the defining equations to
// rounding, in either orientation.
TEST(LeadingSvdOf, ChosenTripletsAreFoundOnBothWays) {
  for (const Eigen::Index size : {30, 410}) {
    const Eigen::MatrixXd u = orthonormal(size + 12, 8, 1), v = orthonormal(size, 8, 2);
    Eigen::VectorXd values(8);
    for (Eigen::Index j = 0; j < 8; ++j) values[j] = std::pow(10.0, -0.5 * static_cast<double>(j));  // to 3e-4
    const Eigen::MatrixXd a = u * values.asDiagonal() * v.transpose();
    for (const Eigen::MatrixXd& m : {a, Eigen::MatrixXd(a.transpose())}) {
      const LeadingSvd svd = leading_svd(m, 5);
      EXPECT_EQ(svd.u.rows(), m.rows());
      EXPECT_EQ(svd.v.rows(), m.cols());
      EXPECT_LT((svd.values - values.head(5)).norm(), 1e-13);
      EXPECT_LT((m * svd.v - svd.u * svd.values.asDiagonal()).norm(), 1e-13);
      EXPECT_LT((m.transpose() * svd.u - svd.v * svd.values.asDiagonal()).norm(), 1e-13);
      EXPECT_LT((svd.u.transpose() * svd.u - Eigen::MatrixXd::Identity(5, 5)).norm(), 1e-13);
      EXPECT_LT((svd.v.transpose() * svd.v - Eigen::MatrixXd::Identity(5, 5)).norm(), 1e-13);
      expect_signs(svd);
    }
  }
}

// sigma_n = 1e-6 sigma_1: its square is lost beside the first one's to four digits; the steps with A itself restore it.
// Tolerance of the sine: rounding of A, some 1e-15 sigma_1, over sigma_3; the squares alone leave 1e-4.
TEST(LeadingSvdOf, ASmallTripletHasItsAccuracyInSpiteOfTheSquares) {
  const Eigen::MatrixXd u = orthonormal(420, 3, 3), v = orthonormal(405, 3, 4);
  const Eigen::Vector3d values(1.0, 1e-3, 1e-6);
  const LeadingSvd svd = leading_svd(u * values.asDiagonal() * v.transpose(), 3);
  for (Eigen::Index j = 0; j < 3; ++j) {
    EXPECT_NEAR(svd.values[j], values[j], 1e-14) << j;
    EXPECT_LT((svd.u.col(j) - u.col(j) * u.col(j).dot(svd.u.col(j))).norm(), 1e-8);  // the sine
    EXPECT_LT((svd.v.col(j) - v.col(j) * v.col(j).dot(svd.v.col(j))).norm(), 1e-8);
  }
}

// Below the rank the values are zero and the vectors still orthonormal.
TEST(LeadingSvdOf, AMatrixOfLowerRankHasZeroValuesAndOrthonormalVectors) {
  for (const Eigen::Index size : {20, 405}) {
    const LeadingSvd svd = leading_svd(orthonormal(size + 5, 2, 5) * orthonormal(size, 2, 6).transpose(), 4);
    EXPECT_LT((svd.values - Eigen::Vector4d(1.0, 1.0, 0.0, 0.0)).norm(), 1e-12) << size;
    EXPECT_LT((svd.u.transpose() * svd.u - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-12) << size;
    EXPECT_LT((svd.v.transpose() * svd.v - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-12) << size;
  }
}

TEST(LeadingSvdOf, MoreTripletsThanTheMatrixHasIsOurMistake) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Identity(4, 3);
  EXPECT_EQ(leading_svd(a, 3).values.size(), 3);
  EXPECT_THROW(static_cast<void>(leading_svd(a, 4)), InternalError);
  EXPECT_THROW(static_cast<void>(leading_svd(a, 0)), InternalError);
}

}  // namespace
}  // namespace twindeck::identification
