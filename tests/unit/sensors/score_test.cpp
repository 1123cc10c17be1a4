#include "sensors/score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

// Oracle: extremes of Eq. (1): orthogonal shapes 0, equal shapes 1 whatever their scale and sign; a mode that is not seen is alike to all.
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

}  // namespace
}  // namespace twindeck::sensors
