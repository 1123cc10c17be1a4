#include "updating/valley_walk.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "updating/bounded_quadratic.hpp"

namespace twindeck::updating {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double cost_left = 1e-6;     // [-] difference of equal costs; ends of one optimum differ by 1e-8
constexpr double equally_near = 1e-6;  // [ranges] distance of parameters that count as equal, as `bound_tolerance`
constexpr double least_ridge = 1e-9;   // [-] of the largest singular value; the ridge shifts the point by as little

double largest_singular_value(const MatrixXd& per_range) {
  if (per_range.size() == 0) return 0.0;
  return Eigen::JacobiSVD<MatrixXd>(per_range).singularValues()(0);
}

/// Components that no multiplier holds on a bound. A multiplier below the search's tolerance counts as zero.
std::vector<Index> movable(const VectorXd& gradient, const MatrixXd& per_range, const VectorXd& x, const Box& box,
                           const Sight& sight) {
  const double rounding = sight.optimality_tolerance * gradient_reference(gradient, per_range, sight.negligible);
  const std::vector<bool> is_held = held(x, gradient, box, sight.bound_tolerance);
  std::vector<Index> free;
  for (Index j = 0; j < x.size(); ++j)
    if (!is_held[static_cast<std::size_t>(j)] || std::abs(gradient(j)) <= rounding) free.push_back(j);
  return free;
}

constexpr int most_walks = 20;           // a curved valley needs one more walk for each digit or two
constexpr double worth_a_walk = 1e-5;    // [ranges] shortest walk; the end of a linearised valley is known to 1e-6
constexpr double shortest_share = 0.05;  // [-] of a step; if the step must be cut further, the valley is too curved

constexpr double probe = 0.1;  // [ranges] length of a probe: far above a search's tolerance, and still inside a curved valley
constexpr double least_probe = 0.01;  // [ranges] shortest probe; with less room the bounds limit a direction
constexpr double stays_away = 0.5;    // [-] part of the probe that the end must stay away from the start

// Signed distance from x along a direction to the box, on the side with more room, in ranges and at most `probe`.
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

// Joins a search and its continuation; the records of the continuation follow those of the first.
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

double Sight::least_change(double largest) const { return std::sqrt(optimality_tolerance * negligible * largest); }

MatrixXd flat_directions(const VectorXd& residual, const MatrixXd& jacobian, const VectorXd& x, const Box& box,
                         const Sight& sight) {
  TWINDECK_ASSERT(jacobian.cols() == x.size() && jacobian.rows() == residual.size());
  const MatrixXd per_range = jacobian * (box.upper - box.lower).asDiagonal();
  const double least = sight.least_change(largest_singular_value(per_range));
  std::vector<Index> seen;
  std::vector<VectorXd> directions;
  for (const Index j : movable(per_range.transpose() * residual, per_range, x, box, sight)) {
    if (per_range.col(j).norm() > least) {
      seen.push_back(j);
      continue;
    }
    directions.emplace_back(VectorXd::Unit(x.size(), j));
  }
  if (!seen.empty()) {
    const Eigen::JacobiSVD<MatrixXd> svd(per_range(Eigen::all, seen), Eigen::ComputeFullV);
    const VectorXd& size = svd.singularValues();
    for (Index k = 0; k < std::ssize(seen); ++k) {
      if (k < size.size() && size(k) > least) continue;
      VectorXd direction = VectorXd::Zero(x.size());
      direction(seen) = svd.matrixV().col(k);
      directions.push_back(direction);
    }
  }
  MatrixXd flat(x.size(), std::ssize(directions));
  for (std::size_t k = 0; k < directions.size(); ++k) flat.col(static_cast<Index>(k)) = directions[k];
  return flat;
}

VectorXd nearest_in_valley(const VectorXd& residual, const MatrixXd& jacobian, const VectorXd& x, const VectorXd& wanted,
                           const Box& box, const Sight& sight) {
  const VectorXd range = box.upper - box.lower;
  const MatrixXd per_range = jacobian * range.asDiagonal();
  const double least = sight.least_change(largest_singular_value(per_range));
  if (least == 0.0) return wanted;  // nothing changes any residual
  const Index m = residual.size(), n = x.size();
  MatrixXd rows(m + n, n);
  rows << per_range, least * MatrixXd::Identity(n, n);
  VectorXd values(m + n);
  values << residual, least * (x - wanted).cwiseQuotient(range);
  const Box in_ranges{box.lower.cwiseQuotient(range), box.upper.cwiseQuotient(range)};
  const VectorXd step = bounded_gauss_newton_step(values, rows, x.cwiseQuotient(range), in_ranges, least_ridge * least * least);
  VectorXd nearest = (x + step.cwiseProduct(range)).cwiseMax(box.lower).cwiseMin(box.upper);
  for (Index j = 0; j < n; ++j)
    if (per_range.col(j).norm() <= least) nearest(j) = wanted(j);
  return nearest;
}

double distance(const VectorXd& a, const VectorXd& b, const Box& box) {
  return (a - b).cwiseQuotient(box.upper - box.lower).norm();
}

bool equal_cost(double a, double b, double negligible) {
  return std::abs(a - b) <= cost_left * std::max({std::abs(a), std::abs(b), negligible * negligible});
}

int preferred_end(const std::vector<EndPoint>& ends, const std::vector<int>& optimum, int cheapest, const VectorXd& wanted,
                  const Box& box, const Sight& sight) {
  const auto at = [&](int k) -> const EndPoint& { return ends[static_cast<std::size_t>(k)]; };
  int nearest = -1;
  double way = 0.0;
  for (int k = 0; k < static_cast<int>(ends.size()); ++k) {
    if (!at(k).converged || !equal_cost(at(k).cost, at(cheapest).cost, sight.negligible)) continue;
    const double way_of_k = distance(at(k).x, wanted, box);
    if (nearest >= 0 && way_of_k > way - equally_near) continue;
    nearest = k;
    way = way_of_k;
  }
  const EndPoint& end = at(nearest);
  const bool valley = flat_directions(end.residual, end.jacobian, end.x, box, sight).cols() > 0;
  return valley ? nearest : optimum[static_cast<std::size_t>(nearest)];
}

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
