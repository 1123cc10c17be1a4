#include "diagnosis/inference/guard.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Prediction of one block by an explanation, from all other rows.
struct Fold {
  double log_evidence = 0.0;  ///< ln evidence of the other rows, prior included
  double log_density = 0.0;   ///< ln predictive density of the block
  double square = 0.0;        ///< squared standardised residual of the block, mean over magnitudes
};

Fold fold_of(const Explanation& e, const MatrixXd& u, const VectorXd& chi_squared, const std::vector<int>& block) {
  const MatrixXd lower = linalg::cholesky_factor(e.precision->matrix(block, block));
  TWINDECK_ASSERT(lower.size() > 0);
  const double log_block = 2.0 * lower.diagonal().array().log().sum();
  const VectorXd own = linalg::lower_solve(lower, u(block, Eigen::all)).colwise().squaredNorm();
  const auto rows = static_cast<double>(block.size());
  std::vector<double> weight, joint;
  for (Index k = 0; k < own.size(); ++k) {
    weight.push_back(e.log_weight[k] - 0.5 * (chi_squared[k] - own[k]) - 0.5 * (e.precision->log_determinant + log_block));
    joint.push_back(weight.back() + 0.5 * (log_block - own[k]) - 0.5 * rows * std::log(2.0 * std::numbers::pi));
  }
  Fold out;
  out.log_evidence = log_sum(weight);
  out.log_density = log_sum(joint) - out.log_evidence;
  for (Index k = 0; k < own.size(); ++k)
    out.square += std::exp(weight[static_cast<std::size_t>(k)] - out.log_evidence) * own[k];
  return out;
}

double reduction_of(double before, double after) { return before > 0.0 ? 100.0 * (1.0 - std::sqrt(after / before)) : 0.0; }

void resample(PredictiveGain& out, int bootstrap, std::uint64_t seed) {
  double before = 0.0, after = 0.0;
  for (const BlockGain& b : out.blocks) {
    out.log_gain += b.log_gain;
    before += b.before;
    after += b.after;
  }
  out.reduction_pct = reduction_of(before, after);
  if (out.blocks.size() < 3) {
    out.low = std::min(0.0, out.log_gain);
    out.high = std::max(0.0, out.log_gain);
    out.low_pct = std::min(0.0, out.reduction_pct);
    out.high_pct = std::max(0.0, out.reduction_pct);
    return;
  }
  std::mt19937_64 random(seed);
  std::vector<double> gain, reduction;
  for (int i = 0; i < bootstrap; ++i) {
    double sum = 0.0;
    before = after = 0.0;
    for (std::size_t k = 0; k < out.blocks.size(); ++k) {
      const BlockGain& b = out.blocks[random() % out.blocks.size()];
      sum += b.log_gain;
      before += b.before;
      after += b.after;
    }
    gain.push_back(sum);
    reduction.push_back(reduction_of(before, after));
  }
  std::sort(gain.begin(), gain.end());
  std::sort(reduction.begin(), reduction.end());
  const auto low = static_cast<std::size_t>(0.05 * bootstrap), high = static_cast<std::size_t>(0.95 * bootstrap);
  out.low = gain[low];
  out.high = gain[high];
  out.low_pct = reduction[low];
  out.high_pct = reduction[high];
}

}  // namespace

double log_sum(const std::vector<double>& v) {
  const double top = *std::max_element(v.begin(), v.end());
  double sum = 0.0;
  for (const double value : v) sum += std::exp(value - top);
  return top + std::log(sum);
}

PredictiveGain gain_of_odds(const std::vector<std::vector<int>>& blocks, const Explanation& none,
                            const std::vector<Explanation>& entries, int bootstrap, std::uint64_t seed) {
  PredictiveGain out;
  if (entries.empty()) return out;
  std::vector<const Explanation*> all = {&none};
  for (const Explanation& e : entries) all.push_back(&e);
  std::vector<MatrixXd> u;
  std::vector<VectorXd> chi_squared;
  for (const Explanation* e : all) {
    u.push_back(linalg::product(e->precision->matrix, e->left));
    chi_squared.emplace_back(u.back().cwiseProduct(e->left).colwise().sum());
  }
  for (const std::vector<int>& block : blocks) {
    BlockGain gain;
    gain.rows = static_cast<int>(block.size());
    std::vector<double> rest, whole, square;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Fold fold = fold_of(*all[k], u[k], chi_squared[k], block);
      rest.push_back(fold.log_evidence);
      whole.push_back(fold.log_evidence + fold.log_density);
      square.push_back(fold.square);
    }
    gain.before = square.front();
    const double sum = log_sum(rest);
    for (std::size_t k = 0; k < all.size(); ++k) gain.after += std::exp(rest[k] - sum) * square[k];
    gain.chosen = static_cast<int>(std::max_element(rest.begin(), rest.end()) - rest.begin()) - 1;
    gain.log_gain = (log_sum(whole) - whole.front()) - (sum - rest.front());
    out.blocks.push_back(gain);
  }
  resample(out, bootstrap, seed);
  return out;
}

}  // namespace twindeck::diagnosis
