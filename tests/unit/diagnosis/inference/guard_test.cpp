// Gain on blocks left out. Oracles: conditional normal laws from the covariance of the seen rows alone; data made with and
// without a cause.
#include "diagnosis/inference/guard.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

namespace twindeck::tests {
namespace {

using diagnosis::Explanation;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Eight modes of five rows each; the first row of a mode is its frequency, errors of the form are shared by the other four.
struct Rows {
  static constexpr int modes = 8, each = 5;
  MatrixXd factor, columns;
  std::vector<std::vector<int>> blocks;
  VectorXd cause;
  std::mt19937_64 random;

  explicit Rows(unsigned seed) : random(seed) {
    const Index n = modes * each;
    factor = MatrixXd::Identity(n, n) * 0.5;
    columns = MatrixXd::Zero(n, modes + 2);
    cause.resize(n);
    std::normal_distribution<double> normal;
    for (int m = 0; m < modes; ++m) {
      blocks.emplace_back();
      for (int k = 0; k < each; ++k) {
        const Index r = m * each + k;
        blocks.back().push_back(static_cast<int>(r));
        columns(r, m) = 0.8;
        columns(r, modes) = 0.3 * normal(random);
        columns(r, modes + 1) = 0.3 * normal(random);
        cause[r] = normal(random);
      }
    }
  }
  std::shared_ptr<const diagnosis::Precision> precision() const {
    const MatrixXd sigma = factor * factor.transpose() + columns * columns.transpose();
    const MatrixXd lower = sigma.llt().matrixL();
    return std::make_shared<diagnosis::Precision>(
        diagnosis::Precision{sigma.inverse(), 2.0 * lower.diagonal().array().log().sum()});
  }
  VectorXd draw() {
    std::normal_distribution<double> normal;
    VectorXd z(columns.cols()), e(factor.rows());
    for (double& v : z) v = normal(random);
    for (double& v : e) v = normal(random);
    return columns * z + factor * e;
  }
  Explanation none(const VectorXd& r) const { return {precision(), r, VectorXd::Constant(1, std::log(0.5))}; }
  /// Magnitudes from a grid, the prior of a catalogue's entry.
  Explanation entry(const VectorXd& r, const VectorXd& s) const {
    const VectorXd t = VectorXd::LinSpaced(5, 0.4, 2.0);
    Explanation e{precision(), MatrixXd(r.size(), t.size()), VectorXd::Constant(t.size(), std::log(0.1 / 5))};
    for (Index k = 0; k < t.size(); ++k) e.left.col(k) = r - t[k] * s;
    return e;
  }
};

TEST(GainOfOdds, ACauseThatIsThereGainsAndNothingDoesNot) {
  int gained = 0, claimed = 0;
  constexpr int draws = 40;
  for (unsigned i = 0; i < draws; ++i) {
    Rows rows(100 + i);
    // A catalogue of twenty wrong entries beside the right one.
    std::vector<VectorXd> others;
    std::normal_distribution<double> normal;
    for (int k = 0; k < 20; ++k) {
      others.emplace_back(rows.cause.size());
      for (double& v : others.back()) v = normal(rows.random);
    }
    const auto low_of = [&](const VectorXd& r) {
      std::vector<Explanation> entries = {rows.entry(r, rows.cause)};
      for (const VectorXd& s : others) entries.push_back(rows.entry(r, s));
      return diagnosis::gain_of_odds(rows.blocks, rows.none(r), entries, 500, i).low;
    };
    const VectorXd r = rows.draw();
    claimed += low_of(r) > 0.0 ? 1 : 0;
    gained += low_of(r + 1.2 * rows.cause) > 0.0 ? 1 : 0;
  }
  EXPECT_GE(gained, 38);
  EXPECT_LE(claimed, 2);  // 5 % of 40
}

TEST(GainOfOdds, TwoBlocksDecideNothing) {
  Rows rows(9);
  const VectorXd r = rows.draw() + 2.0 * rows.cause;
  const auto gain =
      diagnosis::gain_of_odds({rows.blocks[0], rows.blocks[1]}, rows.none(r), {rows.entry(r, rows.cause)}, 500, 1);
  EXPECT_LE(gain.low, 0.0);
  EXPECT_GE(gain.high, 0.0);
  EXPECT_LE(gain.low_pct, 0.0);
}

TEST(GainOfOdds, IsWhatTheBlockAddsToTheOdds) {
  // ln odds of a cause of one magnitude, from all rows and from those but the block's, by the dense covariance of each.
  Rows rows(6);
  const VectorXd r = rows.draw() + rows.cause;
  Explanation with = rows.none(r - rows.cause);
  with.log_weight.array() += 0.7;
  const auto gain = diagnosis::gain_of_odds(rows.blocks, rows.none(r), {with}, 100, 1);
  const MatrixXd sigma = rows.factor * rows.factor.transpose() + rows.columns * rows.columns.transpose();
  const auto log_odds = [&](const std::vector<int>& seen) {
    const MatrixXd inverse = MatrixXd(sigma(seen, seen)).inverse();
    const VectorXd a = r(seen), b = (r - rows.cause)(seen);
    return std::log1p(std::exp(0.7 + 0.5 * (a.dot(inverse * a) - b.dot(inverse * b))));
  };
  std::vector<int> all(static_cast<std::size_t>(r.size()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  double sum = 0.0;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    std::vector<int> seen;
    for (const int i : all)
      if (std::find(rows.blocks[b].begin(), rows.blocks[b].end(), i) == rows.blocks[b].end()) seen.push_back(i);
    EXPECT_NEAR(gain.blocks[b].log_gain, log_odds(all) - log_odds(seen), 1e-8);
    sum += gain.blocks[b].log_gain;
  }
  EXPECT_NEAR(gain.log_gain, sum, 1e-9);
}

}  // namespace
}  // namespace twindeck::tests
