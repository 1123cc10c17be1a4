#include "sensors/logger.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::sensors {
namespace {
using Eigen::VectorXd;

// Oracle: a logger without errors adds nothing; one with a step gives whole steps, half a step off at the most.
TEST(Logged, RoundsToWholeSteps) {
  const VectorXd motion = VectorXd::LinSpaced(1001, -1.0, 1.0);
  EXPECT_EQ(logged(motion, {}, 1, 1), motion);
  const VectorXd rounded = logged(motion, {0.0, 0.01, 0.0, 0.0}, 1, 1);
  for (Eigen::Index i = 0; i < motion.size(); ++i) {
    EXPECT_NEAR(rounded[i] / 0.01, std::round(rounded[i] / 0.01), 1e-9);
    EXPECT_LE(std::abs(rounded[i] - motion[i]), 0.005 + 1e-12);
  }
}

// Oracle: the clipping limit.
TEST(Logged, ClipsAtItsRange) {
  const VectorXd out = logged(VectorXd::LinSpaced(11, -5.0, 5.0), {0.0, 0.0, 2.0, 0.0}, 1, 1);
  EXPECT_EQ(out.maxCoeff(), 2.0);
  EXPECT_EQ(out.minCoeff(), -2.0);
}

// Oracle: statistics of white noise: standard deviation of the sample deviation sigma/sqrt(2n), of the mean and of the lag-one
// correlation 1/sqrt(n); five of each are never left. Streams differ, the same stream returns.
TEST(Logged, NoiseIsWhiteAndItsOwn) {
  const Eigen::Index n = 100000;
  const LoggerErrors errors{0.3, 0.0, 0.0, 0.0};
  const VectorXd a = logged(VectorXd::Zero(n), errors, 7, 1), b = logged(VectorXd::Zero(n), errors, 7, 2);
  const double root = std::sqrt(static_cast<double>(n));
  EXPECT_NEAR(a.norm() / root, 0.3, 5 * 0.3 / (root * std::sqrt(2.0)));
  EXPECT_NEAR(a.mean(), 0.0, 5 * 0.3 / root);
  EXPECT_NEAR(a.head(n - 1).dot(a.tail(n - 1)) / a.squaredNorm(), 0.0, 5 / root);
  EXPECT_NEAR(a.dot(b) / a.squaredNorm(), 0.0, 5 / root);
  EXPECT_EQ(a, logged(VectorXd::Zero(n), errors, 7, 1));
}

// Oracle: bounds of a line and a half wave of at most the drift's amplitude each.
TEST(Logged, DriftsSlowly) {
  const VectorXd out = logged(VectorXd::Zero(5000), {0.0, 0.0, 0.0, 0.1}, 3, 4);
  EXPECT_EQ(out[0], 0.0);
  EXPECT_LE(out.cwiseAbs().maxCoeff(), 0.2);
  EXPECT_GT(out.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT((out.tail(4999) - out.head(4999)).cwiseAbs().maxCoeff(), 0.1 * (1.0 + 3.2) / 4999);
}

}  // namespace
}  // namespace twindeck::sensors
