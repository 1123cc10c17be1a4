#pragma once

#include <Eigen/Core>
#include <vector>

#include "updating/multi_start.hpp"
#include "updating/optimality.hpp"
#include "updating/search.hpp"

/// The way along a valley of equal cost to its point nearest to given values.
namespace twindeck::updating {

// Valleys of a cost: directions in which parameters can move while no residual changes. A search ends anywhere in a valley,
// where its start and its rounding lead it. The data do not say which of its points is right.

/// From which change on a search sees a direction.
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

/// Whether two ends cost the same as far as a search knows: their difference is what its tolerance leaves, or means nothing.
/// @param negligible  [units of the residuals]
[[nodiscard]] bool equal_cost(double a, double b, double negligible);

/// The end to publish of several: the cheapest; among ends of equal cost the one nearest to `wanted`, the earlier start where
/// two are as near. Of one optimum without a flat direction it is still the cheapest.
/// @param optimum  see `distinct_optima`  @param cheapest  a converged end
[[nodiscard]] int preferred_end(const std::vector<EndPoint>& ends, const std::vector<int>& optimum, int cheapest,
                                const Eigen::VectorXd& wanted, const Box& box, const Sight& sight);

[[nodiscard]] Sight sight_of(const Search& search);

/// Continues an ended search along its valley to the point nearest to `wanted`: a step of the linearised valley, and a search
/// from there back to its floor, in turn, until the point rests. Each walk counts only if it ends nearer and costs no more. An
/// end without a flat direction stays as it is.
/// @param from  converged  @param wanted (n_active) normalised  @param start  its number in the history
[[nodiscard]] SearchEnd walk_towards(const Search& search, const SearchEnd& from, const Eigen::VectorXd& wanted, int start);

/// Those of an end's flat directions that are flat beyond the first order: a search from a tenth of the ranges along one ends
/// at equal cost and far from where it set out. At the optimum of a symmetric structure the slopes of its halves are alike, but
/// a search from beside it returns.
/// @param end  converged
[[nodiscard]] Eigen::MatrixXd directions_of_valley(const Search& search, const SearchEnd& end);

}  // namespace twindeck::updating
