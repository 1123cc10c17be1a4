#include "updating/valley_walk.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace twindeck::updating {
namespace {

constexpr int most_walks = 20;           // a bent valley takes one more for each digit or two
constexpr double worth_a_walk = 1e-5;    // [ranges] the point of a linearised valley is known to 1e-6 of them
constexpr double shortest_share = 0.05;  // [-] of a step: where less is wanted the valley bends too much to be one

constexpr double probe = 0.1;         // [ranges] far beyond a search's tolerance, and inside a valley that bends
constexpr double least_probe = 0.01;  // [ranges] a direction with less way inside the box is the bounds' matter
constexpr double stays_away = 0.5;    // [-] of the probe

// The longer way of the two from x along a direction inside the box, in units of the ranges and at most a probe; with its sign.
double way_along(const Eigen::VectorXd& direction, const Eigen::VectorXd& x, const Box& box) {
  const Eigen::ArrayXd range = box.upper - box.lower;
  double up = probe, down = probe;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    if (direction(j) == 0.0) continue;
    const double above = (box.upper(j) - x(j)) / range(j) / std::abs(direction(j)),
                 below = (x(j) - box.lower(j)) / range(j) / std::abs(direction(j));
    up = std::min(up, direction(j) > 0.0 ? above : below);
    down = std::min(down, direction(j) > 0.0 ? below : above);
  }
  return up >= down ? up : -down;
}

// The search that went on, as one: its records follow those of the first.
SearchEnd joined(const SearchEnd& first, SearchEnd next) {
  for (IterationRecord& record : next.history) record.outer += first.result.outer;
  next.history.insert(next.history.begin(), first.history.begin(), first.history.end());
  next.result.initial = first.result.initial;
  next.result.iterations += first.result.iterations;
  next.result.solves += first.result.solves;
  next.result.outer += first.result.outer;
  return next;
}

}  // namespace

Sight sight_of(const Search& search) {
  return {search.definition.negligible_residual(), search.options.optimality_tolerance, search.options.bound_tolerance};
}

SearchEnd walk_towards(const Search& search, const SearchEnd& from, const Eigen::VectorXd& wanted, int start) {
  const Sight sight = sight_of(search);
  SearchEnd end = from;
  if (flat_directions(end.end.residual, end.end.jacobian, end.end.x, search.box, sight).cols() == 0) return end;
  double share = 1.0;
  for (int walk = 0; walk < most_walks && share >= shortest_share; ++walk) {
    const Eigen::VectorXd& here = end.end.x;
    const Eigen::VectorXd nearest = nearest_in_valley(end.end.residual, end.end.jacobian, here, wanted, search.box, sight);
    if (distance(nearest, here, search.box) <= worth_a_walk) break;
    SearchEnd next = run_start(search, here + share * (nearest - here), start);
    const bool counts = next.result.converged && equal_cost(next.result.cost, from.result.cost, sight.negligible) &&
                        distance(next.end.x, wanted, search.box) < distance(here, wanted, search.box);
    if (counts)
      end = joined(end, std::move(next));
    else
      share *= 0.5;
  }
  return end;
}

Eigen::MatrixXd directions_of_valley(const Search& search, const SearchEnd& end) {
  const Sight sight = sight_of(search);
  const Eigen::VectorXd& x = end.end.x;
  const Eigen::MatrixXd flat = flat_directions(end.end.residual, end.end.jacobian, x, search.box, sight);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < flat.cols(); ++k) {
    const double way = way_along(flat.col(k), x, search.box);
    if (std::abs(way) < least_probe) continue;
    const Eigen::VectorXd step = way * flat.col(k).cwiseProduct(search.box.upper - search.box.lower);
    const SearchEnd probed = run_start(search, x + step, 0);
    if (probed.result.converged && equal_cost(probed.result.cost, end.result.cost, sight.negligible) &&
        distance(probed.end.x, x, search.box) >= stays_away * std::abs(way))
      kept.push_back(k);
  }
  return flat(Eigen::all, kept);
}

}  // namespace twindeck::updating
