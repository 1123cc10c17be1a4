#include "updating/leave_one_out.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace twindeck::updating {
namespace {

constexpr double same_cost = 1e-3;  ///< [-] relative: ends whose costs agree to this are equally good fits

Search without(const Search& search, std::size_t target) {
  Search left = search;
  left.definition.targets[target].fitted = false;
  return left;
}

LeftOut predicted(const Search& search, std::size_t target, const SearchEnd& from_initial, const SearchEnd& from_optimum) {
  const auto at = static_cast<Eigen::Index>(target);
  const SearchEnd &a = from_initial, &b = from_optimum;
  const bool both = a.result.converged && b.result.converged;
  const bool equal = both && std::abs(a.result.cost - b.result.cost) <= same_cost * std::min(a.result.cost, b.result.cost);
  const SearchEnd& best = !b.result.converged || equal || (a.result.converged && a.result.cost < b.result.cost) ? a : b;
  LeftOut out;
  out.theta = best.result.theta;
  out.cost = best.result.cost;
  out.converged = best.result.converged;
  if (!best.evaluation.valid) return out;
  out.frequency_Hz = best.evaluation.frequency_Hz(at);
  out.followed_mac = best.evaluation.mac(at);
  if (equal) out.range_Hz = std::abs(a.evaluation.frequency_Hz(at) - b.evaluation.frequency_Hz(at));
  const std::vector<int> side = on_bound(best.end.x, search.box, search.options.bound_tolerance);
  out.on_bounds = static_cast<int>(std::count_if(side.begin(), side.end(), [](int s) { return s != 0; }));
  return out;
}

}  // namespace

std::vector<LeftOut> leave_each_out(const Search& search, const Eigen::VectorXd& initial, const Eigen::VectorXd& optimum) {
  const auto count = static_cast<int>(search.definition.targets.size());
  if (count < 2) return {};
  std::vector<SearchEnd> ends(2 * static_cast<std::size_t>(count));
  parallel_for(2 * count, [&](int k) {
    const auto target = static_cast<std::size_t>(k / 2);
    ends[static_cast<std::size_t>(k)] = run_start(without(search, target), k % 2 == 0 ? initial : optimum, k);
  });
  std::vector<LeftOut> out;
  for (std::size_t target = 0; target < static_cast<std::size_t>(count); ++target) {
    out.push_back(predicted(search, target, ends[2 * target], ends[2 * target + 1]));
  }
  return out;
}

}  // namespace twindeck::updating
