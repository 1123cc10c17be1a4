#include "reliability/subset_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/distributions.hpp"
#include "core/random.hpp"

namespace twindeck::reliability {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Acceptance that the chains' step is adapted to, and how often in a level (Papaioannou et al. 2015, section 5.2).
constexpr double kAcceptance = 0.44;
constexpr int kAdaptations = 10;

/// One level: samples with their values, in chains of equal length one after the other.
struct Level {
  MatrixXd u;
  VectorXd g;
  Index chain = 1;  ///< length of a chain
};

class Chains {
 public:
  Chains(const LimitState& g, Index n, const SubsetOptions& options) : g_(g), n_(n), options_(options) {}

  double value(const VectorXd& u) {
    ++calls;
    const double g = g_(u);
    return std::isfinite(g) ? g : -1.0;
  }

  VectorXd normal() {
    VectorXd u(n_);
    for (Index i = 0; i < n_; ++i) u[i] = normal_number(options_.seed, stream_, static_cast<std::uint64_t>(i));
    ++stream_;
    return u;
  }

  /// Puts the seeds into random order. The step is adapted from chain to chain; if it depended on the value of the seed, the
  /// samples would leave the conditional distribution.
  void shuffle(std::vector<Index>& order) {
    for (std::size_t i = order.size(); i > 1; --i) {
      const double share = uniform_number(options_.seed, stream_, i);
      std::swap(order[i - 1], order[static_cast<std::size_t>(share * static_cast<double>(i))]);
    }
    ++stream_;
  }

  Level first() {
    Level level{MatrixXd(n_, options_.samples), VectorXd(options_.samples), 1};
    for (Index i = 0; i < level.g.size(); ++i) {
      level.u.col(i) = normal();
      level.g[i] = value(level.u.col(i));
    }
    return level;
  }

  /// Chains from the seeds. All their samples are at or below `limit`.
  Level next(const MatrixXd& seeds, const VectorXd& values, double limit) {
    const Index n_seeds = seeds.cols(), length = options_.samples / n_seeds;
    Level level{MatrixXd(n_, n_seeds * length), VectorXd(n_seeds * length), length};
    const Index between = std::max<Index>(1, n_seeds / kAdaptations);
    Index accepted = 0, tried = 0;
    int adaptation = 0;
    for (Index s = 0; s < n_seeds; ++s) {
      VectorXd u = seeds.col(s);
      double g = values[s];
      for (Index k = 0; k < length; ++k) {
        level.u.col(s * length + k) = u;
        level.g[s * length + k] = g;
        if (k + 1 == length) break;
        const double deviation = std::min(1.0, scale_);
        const VectorXd proposed = std::sqrt(1.0 - deviation * deviation) * u + deviation * normal();
        const double g_proposed = value(proposed);
        ++tried;
        if (g_proposed <= limit) {
          u = proposed;
          g = g_proposed;
          ++accepted;
        }
      }
      if ((s + 1) % between == 0 && tried > 0) {
        const double share = static_cast<double>(accepted) / static_cast<double>(tried);
        scale_ *= std::exp((share - kAcceptance) / std::sqrt(static_cast<double>(++adaptation)));
        accepted = tried = 0;
      }
    }
    return level;
  }

  int calls = 0;

 private:
  const LimitState& g_;
  Index n_;
  const SubsetOptions& options_;
  std::uint64_t stream_ = 0;
  double scale_ = 0.6;
};

/// Squared coefficient of variation of a level's share (Au and Beck 2001, Eqs. 25 to 28).
double squared_variation(const Level& level, double limit, double share) {
  const Index n = level.g.size(), chains = n / level.chain;
  double correlation = 0.0;
  for (Index lag = 1; lag < level.chain; ++lag) {
    double sum = 0.0;
    for (Index c = 0; c < chains; ++c)
      for (Index k = 0; k + lag < level.chain; ++k)
        sum += (level.g[c * level.chain + k] <= limit && level.g[c * level.chain + k + lag] <= limit) ? 1.0 : 0.0;
    const double at_lag = sum / static_cast<double>(n - lag * chains) - share * share;
    correlation += 2.0 * (1.0 - static_cast<double>(lag) / static_cast<double>(level.chain)) * at_lag / (share * (1.0 - share));
  }
  return (1.0 - share) / (share * static_cast<double>(n)) * (1.0 + std::max(correlation, 0.0));
}

}  // namespace

SubsetResult subset_simulation(const LimitState& g, Index n, const SubsetOptions& options) {
  TWINDECK_ASSERT(n >= 1 && options.samples >= 100 && options.level_share > 0.0 && options.level_share <= 0.5);
  SubsetResult result;
  Chains chains(g, n, options);
  Level level = chains.first();
  const auto kept = static_cast<Index>(std::lround(options.level_share * options.samples));
  if ((level.g.array() <= 0.0).all())
    throw InputError({"", 0, "limit state"}, fmt::format("is exceeded in all of {} samples", options.samples),
                     "check the limit's value and sign");
  double logarithm = 0.0, variation = 0.0;
  for (result.levels = 1;; ++result.levels) {
    std::vector<Index> order(static_cast<std::size_t>(level.g.size()));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](Index a, Index b) { return level.g[a] < level.g[b]; });
    const double limit = std::max(level.g[order[static_cast<std::size_t>(kept - 1)]], 0.0);
    const auto inside = static_cast<Index>((level.g.array() <= limit).count());
    const double share = static_cast<double>(inside) / static_cast<double>(level.g.size());
    if (inside > 0) {
      logarithm += std::log(share);
      variation += squared_variation(level, limit, share);
    }
    const Index seeds = limit > 0.0 ? kept : inside;
    order.resize(static_cast<std::size_t>(seeds));
    chains.shuffle(order);
    MatrixXd u(n, seeds);
    VectorXd values(seeds);
    for (Index i = 0; i < seeds; ++i) {
      u.col(i) = level.u.col(order[static_cast<std::size_t>(i)]);
      values[i] = level.g[order[static_cast<std::size_t>(i)]];
    }
    if (limit <= 0.0) {
      result.failed = u;
      break;
    }
    if (result.levels >= options.largest_levels) {
      result.status = {false, fmt::format("subset simulation did not reach the limit in {} levels: its probability is below "
                                          "{:.1e}, or it is never exceeded",
                                          result.levels, std::pow(options.level_share, result.levels))};
      break;
    }
    level = chains.next(u, values, limit);
  }
  result.calls = chains.calls;
  if (result.status.converged) {
    result.probability = std::exp(logarithm);
    result.variation = std::sqrt(variation);
  }
  return result;
}

bool hidden_region(const SubsetResult& subset, const LimitState& g, const Eigen::Ref<const VectorXd>& design_point,
                   std::uint64_t seed) {
  constexpr int points = 200;         ///< their scatter is 3.5 % of Phi(-beta) at most
  constexpr double deviations = 3.0;  ///< of the logarithm; above this a region counts as missed
  const double beta = design_point.norm(), half_space = normal_tail(beta);
  const VectorXd along = design_point / beta;
  int failed = 0;
  const std::uint64_t own = mixed(seed);  // numbers that the subset simulation does not draw
  for (std::uint64_t k = 0; k < points; ++k) {
    VectorXd u(design_point.size());
    for (Index i = 0; i < u.size(); ++i) u[i] = normal_number(own, k, static_cast<std::uint64_t>(i));
    const double beyond = -normal_quantile((1.0 - uniform_number(own, points, k)) * half_space);
    u += (beyond - along.dot(u)) * along;
    failed += g(u) <= 0.0 ? 1 : 0;
  }
  if (failed == 0) return false;
  const double share = static_cast<double>(failed) / points, square = (1.0 - share) / (share * points);
  return std::log(half_space * share / subset.probability) >
         deviations * std::sqrt(square + subset.variation * subset.variation);
}

}  // namespace twindeck::reliability
