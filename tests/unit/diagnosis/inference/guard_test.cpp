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
  VectorXd draw() {
    std::normal_distribution<double> normal;
    VectorXd z(columns.cols()), e(factor.rows());
    for (double& v : z) v = normal(random);
    for (double& v : e) v = normal(random);
    return columns * z + factor * e;
  }
  Explanation none(const VectorXd& r) const {
    return {diagnosis::precision_of(factor, columns), r, VectorXd::Constant(1, std::log(0.5))};
  }
  /// Magnitudes from a grid, the prior of a catalogue's entry.
  Explanation entry(const VectorXd& r, const VectorXd& s) const {
    const VectorXd t = VectorXd::LinSpaced(5, 0.4, 2.0);
    Explanation e{diagnosis::precision_of(factor, columns), MatrixXd(r.size(), t.size()),
                  VectorXd::Constant(t.size(), std::log(0.1 / 5))};
    for (Index k = 0; k < t.size(); ++k) e.left.col(k) = r - t[k] * s;
    return e;
  }
};

TEST(Precision, IsTheInverseOfTheCovariance) {
  Rows rows(3);
  MatrixXd sigma = rows.factor * rows.factor.transpose() + rows.columns * rows.columns.transpose();
  const auto precision = diagnosis::precision_of(rows.factor, rows.columns);
  EXPECT_LT((precision->matrix * sigma - MatrixXd::Identity(sigma.rows(), sigma.cols())).cwiseAbs().maxCoeff(), 1e-10);
  const MatrixXd lower = sigma.llt().matrixL();
  EXPECT_NEAR(precision->log_determinant, 2.0 * lower.diagonal().array().log().sum(), 1e-9);
}

TEST(LeaveOneOut, IsTheConditionalLawOfTheBlock) {
  // One entry of one magnitude: its predictive density and none's, each from the covariance of the seen rows.
  Rows rows(4);
  const VectorXd r = rows.draw() + rows.cause;
  Explanation with = rows.none(r - rows.cause);
  const auto gain = diagnosis::leave_one_out(rows.blocks, rows.none(r), {with}, 100, 1);
  const MatrixXd sigma = rows.factor * rows.factor.transpose() + rows.columns * rows.columns.transpose();
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    const std::vector<int>& block = rows.blocks[b];
    std::vector<int> seen;
    for (int i = 0; i < r.size(); ++i)
      if (std::find(block.begin(), block.end(), i) == block.end()) seen.push_back(i);
    const Eigen::LLT<MatrixXd> factor(MatrixXd(sigma(seen, seen)));
    const MatrixXd conditional = sigma(block, block) - sigma(block, seen) * factor.solve(MatrixXd(sigma(seen, block)));
    const auto log_density = [&](const VectorXd& left) {
      const VectorXd e = left(block) - sigma(block, seen) * factor.solve(VectorXd(left(seen)));
      return -0.5 * (e.dot(conditional.llt().solve(e)) + std::log(conditional.determinant()) +
                     static_cast<double>(block.size()) * std::log(2.0 * std::numbers::pi));
    };
    EXPECT_NEAR(gain.blocks[b].log_gain, log_density(r - rows.cause) - log_density(r), 1e-8);
    EXPECT_EQ(gain.blocks[b].rows, 5);
  }
}

TEST(LeaveOneOut, MagnitudesAreWeighedByTheSeenRowsAlone) {
  // Two magnitudes; the rows of the first block fit the second one perfectly and all others the first: it must be predicted
  // with the first.
  Rows rows(5);
  VectorXd r = 0.01 * rows.draw() + rows.cause;
  for (const int k : rows.blocks[0]) r[k] = 2.0 * rows.cause[k];
  Explanation e = rows.none(r);
  e.left.resize(r.size(), 2);
  e.left.col(0) = r - rows.cause;
  e.left.col(1) = r - 2.0 * rows.cause;
  e.log_weight = VectorXd::Constant(2, std::log(0.05));
  Explanation first = rows.none(VectorXd(e.left.col(0)));
  const auto both = diagnosis::leave_one_out(rows.blocks, rows.none(r), {e}, 100, 1);
  const auto alone = diagnosis::leave_one_out(rows.blocks, rows.none(r), {first}, 100, 1);
  EXPECT_NEAR(both.blocks[0].log_gain, alone.blocks[0].log_gain, 0.02);
}

TEST(LeaveOneOut, ACauseThatIsThereGainsAndNothingDoesNot) {
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
      return diagnosis::leave_one_out(rows.blocks, rows.none(r), entries, 500, i).low;
    };
    const VectorXd r = rows.draw();
    claimed += low_of(r) > 0.0 ? 1 : 0;
    gained += low_of(r + 1.2 * rows.cause) > 0.0 ? 1 : 0;
  }
  EXPECT_GE(gained, 38);
  EXPECT_LE(claimed, 2);  // 5 % of 40
}

TEST(LeaveOneOut, TheEntryIsChosenAnewInEachFold) {
  // Entries that each explain one mode and nothing else, and rows of different modes that have nothing in common: whoever is
  // chosen without a mode says nothing of it.
  Rows rows(8);
  rows.columns.rightCols(2).setZero();
  const VectorXd r = rows.draw() + 3.0 * rows.cause;
  std::vector<Explanation> entries;
  for (const std::vector<int>& block : rows.blocks) {
    VectorXd s = VectorXd::Zero(r.size());
    for (const int k : block) s[k] = 3.0 * rows.cause[k];
    entries.push_back(rows.none(r - s));
  }
  const auto gain = diagnosis::leave_one_out(rows.blocks, rows.none(r), entries, 500, 1);
  for (std::size_t b = 0; b < rows.blocks.size(); ++b) {
    EXPECT_NE(gain.blocks[b].chosen, static_cast<int>(b));
    EXPECT_NEAR(gain.blocks[b].log_gain, 0.0, 1e-9);
  }
}

TEST(LeaveOneOut, TwoBlocksDecideNothing) {
  Rows rows(9);
  const VectorXd r = rows.draw() + 2.0 * rows.cause;
  const auto gain =
      diagnosis::leave_one_out({rows.blocks[0], rows.blocks[1]}, rows.none(r), {rows.entry(r, rows.cause)}, 500, 1);
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
