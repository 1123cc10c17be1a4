/// Oracles: arithmetic by hand with the quantile of a printed table of Student's t (Abramowitz and Stegun, table 26.10).
#include <gtest/gtest.h>

#include <cmath>

#include "buffeting/field_statistics.hpp"
#include "buffeting/response.hpp"
#include "core/error.hpp"

namespace twindeck::buffeting {
namespace {

TEST(Interval, IsWorkedByHand) {
  const Interval found = confidence_interval(Eigen::Vector3d(1.0, 2.0, 3.0), 0.95);
  EXPECT_DOUBLE_EQ(found.mean, 2.0);
  EXPECT_DOUBLE_EQ(found.deviation, 1.0);
  EXPECT_NEAR(found.high - found.mean, 4.302653 / std::sqrt(3.0), 1e-5);
  EXPECT_THROW((void)confidence_interval(Eigen::VectorXd::Ones(1), 0.95), InputError);
}

TEST(RootMeanSquares, AreAboutTheMean) {
  Eigen::MatrixXd history(4, 2);
  history << 1.0, 5.0, -1.0, 5.0, 1.0, 5.0, -1.0, 5.0;
  EXPECT_NEAR((root_mean_squares(history) - Eigen::Vector2d(1.0, 0.0)).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace twindeck::buffeting
