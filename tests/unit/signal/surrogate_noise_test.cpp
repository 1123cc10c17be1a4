// Oracles: Parseval (the lines' products are those of the record, so are all sums of products over the period), the record's
// own cross-correlation; independence of draws within the scatter of a mean.
#include "signal/surrogate_noise.hpp"

#include <gtest/gtest.h>

#include "noise.hpp"

namespace twindeck::signal {
namespace {

/// Two channels: white noise, and the same a sample later with noise of its own; without mean.
Eigen::MatrixXd pair(Eigen::Index n) {
  test::Noise random(3);
  Eigen::MatrixXd x(n, 2);
  double before = 0.0;
  for (Eigen::Index t = 0; t < n; ++t) {
    x(t, 0) = random();
    x(t, 1) = before + 0.3 * random();
    before = x(t, 0);
  }
  return x.rowwise() - x.colwise().mean();
}

Eigen::Matrix2d circular(const Eigen::MatrixXd& x, Eigen::Index lag) {
  Eigen::MatrixXd later(x.rows(), x.cols());
  for (Eigen::Index t = 0; t < x.rows(); ++t) later.row(t) = x.row((t + lag) % x.rows());
  return later.transpose() * x / static_cast<double>(x.rows());
}

TEST(SurrogateNoise, HasTheCorrelationsOfTheRecordAtEveryLag) {
  for (const Eigen::Index n : {200, 201}) {
    const Eigen::MatrixXd x = pair(n), y = surrogate_noise(x, 7, 1);
    ASSERT_EQ(y.rows(), n);
    for (const Eigen::Index lag : {0, 1, 2, 50})
      EXPECT_LT((circular(y, lag) - circular(x, lag)).norm(), 1e-12) << n << " " << lag;
  }
}

TEST(SurrogateNoise, DrawsAreOfTheRecordAndOfEachOtherIndependent) {
  const Eigen::Index n = 2000;
  const Eigen::MatrixXd x = pair(n), a = surrogate_noise(x, 7, 1), b = surrogate_noise(x, 7, 2);
  const double limit = 4.0 / std::sqrt(static_cast<double>(n));
  const auto correlation = [](const Eigen::MatrixXd& p, const Eigen::MatrixXd& q) {
    return std::abs(p.col(0).dot(q.col(0))) / (p.col(0).norm() * q.col(0).norm());
  };
  EXPECT_LT(correlation(a, x), limit);
  EXPECT_LT(correlation(a, b), limit);
  EXPECT_EQ(a, surrogate_noise(x, 7, 1));
}

}  // namespace
}  // namespace twindeck::signal
