#include "updating/leave_one_out.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace twindeck::updating {
namespace {

Search without(const Search& search, std::size_t target) {
  Search left = search;
  left.definition.targets[target].fitted = false;
  if (left.definition.weighted) left.definition.weighted = left.definition.weighted->without(target);
  if (left.definition.prior.given()) left.definition.prior = left.definition.prior.without(static_cast<Eigen::Index>(target));
  return left;
}

LeftOut predicted(const Search& search, std::size_t target, const SearchEnd& end) {
  const auto at = static_cast<Eigen::Index>(target);
  LeftOut out;
  out.theta = end.result.theta;
  out.cost = end.result.cost;
  out.converged = end.result.converged;
  if (!end.evaluation.valid) return out;
  out.frequency_Hz = end.evaluation.frequency_Hz(at);
  out.followed_mac = end.evaluation.mac(at);
  const std::vector<int> side = on_bound(end.end.x, search.box, search.options.bound_tolerance);
  out.on_bounds = static_cast<int>(std::count_if(side.begin(), side.end(), [](int s) { return s != 0; }));
  return out;
}

}  // namespace

std::vector<LeftOut> leave_each_out(const Search& search, const Eigen::VectorXd& initial) {
  const std::size_t count = search.definition.targets.size();
  if (count < 2) return {};
  std::vector<LeftOut> out(count);
  parallel_for(count, [&](std::size_t target) {
    out[target] = predicted(search, target, run_start(without(search, target), initial, static_cast<int>(target)));
  });
  return out;
}

}  // namespace twindeck::updating
