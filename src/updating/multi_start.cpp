#include "updating/multi_start.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/error.hpp"

namespace twindeck::updating {
namespace {

// Uniform in [0, 1) with 53 bits.
double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1.0p-53; }

std::vector<int> permutation(int n, std::mt19937_64& engine) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i) {
    const int j = static_cast<int>(uniform(engine) * (i + 1));
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(j)]);
  }
  return order;
}

bool same_optimum(const EndPoint& a, const EndPoint& b, const Box& box, double residual_tolerance) {
  constexpr double parameter_tolerance = 0.01, cost_tolerance = 1e-3;
  const Eigen::VectorXd difference = a.x - b.x;
  const Eigen::VectorXd range = (box.upper - box.lower).cwiseMax(1e-300);
  if ((difference.array() / range.array()).abs().maxCoeff() <= parameter_tolerance) return true;
  const double scale = std::max({std::abs(a.cost), std::abs(b.cost), residual_tolerance * residual_tolerance});
  if (std::abs(a.cost - b.cost) > cost_tolerance * scale) return false;
  return (a.jacobian * difference).cwiseAbs().maxCoeff() <= residual_tolerance;
}

}  // namespace

Eigen::MatrixXd starting_points(const Eigen::VectorXd& first, const Box& box, int starts, std::uint64_t seed) {
  TWINDECK_ASSERT(starts >= 1);
  Eigen::MatrixXd points(first.size(), starts);
  points.col(0) = first;
  const int drawn = starts - 1;
  std::mt19937_64 engine(seed);
  for (Eigen::Index i = 0; i < first.size(); ++i) {
    const std::vector<int> stratum = permutation(drawn, engine);
    for (int k = 0; k < drawn; ++k) {
      const double fraction = (stratum[static_cast<std::size_t>(k)] + uniform(engine)) / drawn;
      points(i, k + 1) = box.lower(i) + fraction * (box.upper(i) - box.lower(i));
    }
  }
  return points;
}

std::vector<int> distinct_optima(const std::vector<EndPoint>& ends, const Box& box, double negligible) {
  std::vector<std::size_t> order(ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return ends[a].cost < ends[b].cost; });
  std::vector<int> optimum(ends.size(), -1);
  std::vector<std::size_t> representatives;
  for (const std::size_t k : order) {
    if (!ends[k].converged) continue;
    const auto same =
        std::ranges::find_if(representatives, [&](std::size_t r) { return same_optimum(ends[r], ends[k], box, negligible); });
    if (same == representatives.end()) {
      representatives.push_back(k);
      optimum[k] = static_cast<int>(k);
    } else {
      optimum[k] = static_cast<int>(*same);
    }
  }
  return optimum;
}

}  // namespace twindeck::updating
