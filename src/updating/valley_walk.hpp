#pragma once

#include <Eigen/Core>
#include <vector>

#include "updating/multi_start.hpp"
#include "updating/optimality.hpp"
#include "updating/search.hpp"

/// The way along a valley of equal cost to its point nearest to given values.
namespace twindeck::updating {

// Valleys of a cost: directions in which parameters can move while no residual changes. Where a search ends in a valley depends
// on its start and on rounding. The data do not say which point of the valley is right.

/// How small a change of the residuals a search can detect.
struct Sight {
  double negligible = 1e-4;            ///< [units of the residuals] see `gradient_reference`
  double optimality_tolerance = 1e-6;  ///< of the search
  double bound_tolerance = 1e-6;       ///< see `on_bound`

  /// Change of the residuals over the whole range below which a search doesn't see a direction: the gradient σ² along it stays
  /// below the search's tolerance. @param largest  singular value of the Jacobian per range
  [[nodiscard]] double least_change(double largest) const;
};

/// Directions at an end that the search doesn't see, among the components that no multiplier holds on a bound. A parameter that
/// changes no residual by itself is a direction of its own, and comes first.
/// @param residual, jacobian  at x, as in `Linearised`
/// @return (n × n_directions) orthonormal, in units of the ranges; no column where the data determine all parameters
[[nodiscard]] Eigen::MatrixXd flat_directions(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                                              const Eigen::VectorXd& x, const Box& box, const Sight& sight);

/// The point of the linearised valley through x that is nearest to `wanted`, in units of the ranges and inside the box. It is
/// the bounded Gauss-Newton step of the problem with a ridge towards `wanted` that no direction but a flat one feels. A
/// parameter that changes no residual by itself is at its wanted value.
/// Reference: Tikhonov and Arsenin (1977), Solutions of Ill-posed Problems, chapter II (normal solutions).
[[nodiscard]] Eigen::VectorXd nearest_in_valley(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                                                const Eigen::VectorXd& x, const Eigen::VectorXd& wanted, const Box& box,
                                                const Sight& sight);

/// Distance of two points, in units of the ranges.
[[nodiscard]] double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Box& box);

/// Whether two ends cost the same to a search: their costs differ by no more than its tolerance, or negligibly.
/// @param negligible  [units of the residuals]
[[nodiscard]] bool equal_cost(double a, double b, double negligible);

/// The end to publish. It is the cheapest one. Among ends of equal cost it is the one nearest to `wanted`, and among equally
/// near ones the earlier start. For one optimum without a flat direction the cheapest end is kept.
/// @param optimum  see `distinct_optima`  @param cheapest  a converged end
[[nodiscard]] int preferred_end(const std::vector<EndPoint>& ends, const std::vector<int>& optimum, int cheapest,
                                const Eigen::VectorXd& wanted, const Box& box, const Sight& sight);

[[nodiscard]] Sight sight_of(const Search& search);

/// Continues an ended search along its valley to the point nearest to `wanted`: a step along the linearised valley and a search
/// from there alternate, until the point stays. A walk is accepted only if it ends nearer and costs no more. An end without a
/// flat direction stays as it is.
/// @param from  converged  @param wanted (n_active) normalised  @param start  its number in the history
[[nodiscard]] SearchEnd walk_towards(const Search& search, const SearchEnd& from, const Eigen::VectorXd& wanted, int start);

/// Flat directions of an end that remain flat beyond the first order: a search from a point up to a tenth of the ranges away
/// ends at equal cost and far from `end`. At the optimum of a symmetric structure, parameters of the two halves have equal
/// slopes, but a search from a point beside it returns.
/// @param end  converged
[[nodiscard]] Eigen::MatrixXd directions_of_valley(const Search& search, const SearchEnd& end);

}  // namespace twindeck::updating
