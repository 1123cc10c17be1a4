// Oracles: the defining sum, and the closed form a^k / (1 - a²) of a first-order autoregression.
#include "signal/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "noise.hpp"

namespace twindeck::signal {
namespace {

Eigen::MatrixXd white(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  test::Noise noise(seed);
  Eigen::MatrixXd data(rows, columns);
  for (double& x : data.reshaped()) x = noise();
  return data;
}

TEST(Correlation, EqualsTheDefiningSumWhateverTheBlocks) {
  const Eigen::MatrixXd data = white(1501, 3, 3);
  const Eigen::Index n = data.rows();
  for (const Eigen::Index blocks : {1, 4, 7}) {
    const auto lags = correlations(data, {2, 0}, 40, blocks).mean();
    ASSERT_EQ(lags.size(), 40U);
    for (const Eigen::Index k : {0, 1, 17, 39}) {
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double direct = data.col(i).tail(n - k).dot(data.col(2).head(n - k)) / static_cast<double>(n - k);
        EXPECT_NEAR(lags[static_cast<std::size_t>(k)](i, 0), direct, 1e-12);
      }
    }
  }
}

TEST(Correlation, LeavingABlockOutLeavesItsPairsOut) {
  const Eigen::MatrixXd data = white(800, 2, 5);
  const auto lags = correlations(data, {1}, 10, 4).mean(1);  // t in [200, 400) left out
  const Eigen::Index k = 6;
  double sum = 0.0;
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t + k < 800; ++t) {
    if (t >= 200 && t < 400) continue;
    sum += data(t + k, 0) * data(t, 1);
    ++count;
  }
  EXPECT_NEAR(lags[6](0, 0), sum / static_cast<double>(count), 1e-12);
}

TEST(Correlation, OfTwoRecordsTakesThePairsOfBoth) {
  const Eigen::MatrixXd first = white(600, 2, 7), second = white(421, 2, 8);
  BlockCorrelations both;
  both.append(correlations(first, {0}, 12, 3));
  both.append(correlations(second, {0}, 12, 2));
  EXPECT_EQ(both.n_blocks(), 5);
  const Eigen::Index k = 9;
  double sum = 0.0;
  for (const Eigen::MatrixXd* data : {&first, &second}) {
    const Eigen::Index pairs = data->rows() - k;
    sum += data->col(1).tail(pairs).dot(data->col(0).head(pairs));
  }
  EXPECT_NEAR(both.mean()[9](1, 0), sum / static_cast<double>(600 - k + 421 - k), 1e-12);
}

TEST(Correlation, OfAFirstOrderAutoregression) {
  const double a = 0.8;
  Eigen::MatrixXd data = white(400000, 1, 9);
  for (Eigen::Index t = 1; t < data.rows(); ++t) data(t, 0) += a * data(t - 1, 0);
  const auto lags = correlations(data, {0}, 12, 10).mean();
  // Standard deviation by Bartlett's formula is below 0.012 at every lag.
  for (std::size_t k = 0; k < lags.size(); ++k)
    EXPECT_NEAR(lags[k](0, 0), std::pow(a, static_cast<double>(k)) / (1.0 - a * a), 0.04);
}

TEST(Correlation, TooShortABlockIsRefused) {
  EXPECT_THROW(static_cast<void>(correlations(white(100, 1, 1), {0}, 20, 3)), InputError);
}

}  // namespace
}  // namespace twindeck::signal
