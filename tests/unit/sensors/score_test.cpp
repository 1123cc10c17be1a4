#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sensors/setup_scores.hpp"

namespace twindeck::sensors {
namespace {
using Eigen::MatrixXd;

// Oracle: by hand. Columns (1,0), (1,1), (0,1): MAC 1/2, 0, 1/2 off the diagonal, mean over six entries 1/3.
TEST(DecouplingScore, MeanOffTheDiagonal) {
  const MatrixXd phi = (MatrixXd(2, 3) << 1, 1, 0, 0, 1, 1).finished();
  const MatrixXd expected = (MatrixXd(3, 3) << 1, 0.5, 0, 0.5, 1, 0.5, 0, 0.5, 1).finished();
  EXPECT_LT((auto_mac(phi) - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(decoupling_score(phi), 1.0 / 3.0, 1e-15);
}

// Oracle: extremes of Eq. (1): orthogonal shapes 0, equal shapes 1 whatever their scale and sign; a mode that is not seen is
// alike to all.
TEST(DecouplingScore, Extremes) {
  EXPECT_EQ(decoupling_score(MatrixXd::Identity(5, 5)), 0.0);
  EXPECT_NEAR(decoupling_score((MatrixXd(2, 2) << 1, -3, 2, -6).finished()), 1.0, 1e-15);
  EXPECT_NEAR(decoupling_score((MatrixXd(2, 2) << 1, 0, 2, 0).finished()), 1.0, 1e-15);
}

// Oracle: determinant of a 2 × 2 matrix by hand; dependent shapes span nothing.
TEST(LogDeterminant, OfTheGramMatrix) {
  const MatrixXd phi = (MatrixXd(3, 2) << 1, 2, 0, 1, 2, 1).finished();  // Gram [[5, 4], [4, 6]]
  EXPECT_NEAR(log_determinant(phi), std::log(14.0), 1e-14);
  EXPECT_EQ(log_determinant((MatrixXd(2, 2) << 1, 2, 2, 4).finished()), -std::numeric_limits<double>::infinity());
}

// Oracle: rank. Fewer sensors than modes span no volume, and a mode that is a sum of others adds none. The entries have no
// short binary form, so that products of the columns are singular but for rounding, which may leave a determinant of either
// sign.
TEST(LogDeterminant, OfNothingForDependentShapes) {
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  for (const Eigen::Index sensors : {1, 2, 3, 4}) {
    for (const double shift : {0.1, 0.2, 0.3, 0.7}) {
      MatrixXd few(sensors, 5), dependent(sensors + 3, 3);
      for (Eigen::Index i = 0; i < few.size(); ++i) few(i) = std::sin(1.0 + shift * static_cast<double>(i * i));
      for (Eigen::Index i = 0; i < dependent.rows(); ++i) {
        dependent(i, 0) = std::sin(0.3 + shift * static_cast<double>(i));
        dependent(i, 1) = std::cos(0.9 + 2.0 * shift * static_cast<double>(i * i));
        dependent(i, 2) = 0.3 * dependent(i, 0) - 0.7 * dependent(i, 1);
      }
      EXPECT_EQ(log_determinant(few), nothing) << sensors << " sensors, shift " << shift;
      EXPECT_EQ(log_determinant(dependent), nothing) << sensors + 3 << " sensors, shift " << shift;
    }
  }
}

// Oracle: a scaled orthogonal basis, whose determinant is the product of the squared scales: shapes that are small, or alike to
// 1e-5, are not dependent.
TEST(LogDeterminant, OfSmallAndOfSimilarShapes) {
  EXPECT_NEAR(log_determinant(1e-8 * MatrixXd::Identity(4, 3)), 6.0 * std::log(1e-8), 1e-12);
  const MatrixXd alike = (MatrixXd(2, 2) << 1, 1, 0, 1e-5).finished();
  EXPECT_NEAR(log_determinant(alike), 2.0 * std::log(1e-5), 1e-9);
}

}  // namespace
}  // namespace twindeck::sensors
