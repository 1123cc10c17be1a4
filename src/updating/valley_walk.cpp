#include "updating/valley_walk.hpp"

namespace twindeck::updating {
namespace {

constexpr int most_walks = 20;           // a bent valley takes one more for each digit or two
constexpr double worth_a_walk = 1e-5;    // [ranges] the point of a linearised valley is known to 1e-6 of them
constexpr double shortest_share = 0.05;  // [-] of a step: where less is wanted the valley bends too much to be one

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

}  // namespace twindeck::updating
