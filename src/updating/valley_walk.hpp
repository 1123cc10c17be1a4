#pragma once

#include "updating/flat_valley.hpp"
#include "updating/search.hpp"

/// The way along a valley of equal cost to its point nearest to given values.
namespace twindeck::updating {

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
