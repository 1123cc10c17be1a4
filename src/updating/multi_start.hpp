#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "updating/optimality.hpp"

namespace twindeck::updating {

/// Starting points of a multi-start search: `first`, then a Latin hypercube, which covers the range of each parameter evenly.
/// Our own transform makes uniform numbers from std::mt19937_64, because the standard's distributions differ between libraries:
/// the same seed gives the same bytes everywhere.
/// @param starts  number of points, at least 1
/// @return (n × starts)
/// Reference: McKay, Beckman and Conover (1979), Technometrics 21, 239-245.
[[nodiscard]] Eigen::MatrixXd starting_points(const Eigen::VectorXd& first, const Box& box, int starts, std::uint64_t seed);

/// An end point of a search, with the data that are needed to tell optima apart.
struct EndPoint {
  Eigen::VectorXd x;  ///< (n)
  double cost = 0.0;  ///< F(x)
  bool converged = false;
  Eigen::MatrixXd jacobian;  ///< (n_residuals × n) at x
  Eigen::VectorXd residual;  ///< (n_residuals) at x
};

/// Sorts end points into distinct optima. Two are the same optimum if their parameters agree within 1 % of each range; or if
/// their costs agree and the residuals' linearised difference J (x_a - x_b) stays below a negligible size: they then differ
/// only along a direction that changes no residual.
/// @param negligible  in units of the residuals; by default relative frequencies
/// @return for each end point the position of its optimum's representative (the cheapest converged member), -1 if not converged
[[nodiscard]] std::vector<int> distinct_optima(const std::vector<EndPoint>& ends, const Box& box, double negligible = 1e-4);

}  // namespace twindeck::updating
