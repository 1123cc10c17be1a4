#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/error.hpp"

namespace twindeck::reliability {

/// g(u) of independent standard normal numbers u (n): the limit is exceeded where g <= 0. A value that is not finite counts as
/// exceeded. Compose it with RandomVector::values for inputs of other laws.
using LimitState = std::function<double(const Eigen::VectorXd& u)>;

/// Design point: the point of g = 0 nearest to the origin of standard normal space.
struct DesignPoint {
  Eigen::VectorXd u;  ///< (n)
  double beta = 0.0;  ///< [-] its distance, negative where the origin itself exceeds the limit
  Eigen::VectorXd
      alpha;  ///< (n) u/beta; alpha_i² is input i's share of the variance of the linearised limit state (they sum to 1)
};

struct FormOptions {
  int starts = 8;                 ///< random starts beside the origin
  int iterations = 200;           ///< of one search
  double tolerance = 1e-6;        ///< [-] on |u - (alpha'u) alpha| and on |g|/|g(0)|
  double importance_level = 0.1;  ///< the test looks for further points that would add this share or more of Phi(-beta)
  double test_level = 0.95;       ///< probability with which it finds one
  int largest_test = 10000;       ///< calls that the test may use
  double step = 1e-4;             ///< [-] of the central differences of g, in standard deviations
  std::uint64_t seed = 1;
};

struct FormResult {
  Status status;                    ///< not converged: no start reached g = 0 at a point where the gradient is parallel to u
  std::vector<DesignPoint> points;  ///< all that were found, nearest first
  double probability = 0.0;         ///< Phi(-beta) of the nearest
  int calls = 0;                    ///< of g
  bool strong_maximum = false;      ///< true: no second point has that importance, as far as the test can tell
  double level_reached = 0.0;       ///< probability with which the test would have found a second point
};

/// First-order reliability method: beta by the improved Hasofer-Lind-Rackwitz-Fiessler iteration with Armijo's rule on the
/// merit 0.5 |u|² + c |g|, from several starts. Then the strong-maximum test: it evaluates g at points of a sphere a little
/// larger than beta, away from the design points. From each point that exceeds the limit a search starts.
/// @param n  dimension of u
/// @throws InputError  if the limit is exceeded, or is not, at the origin and at every start
/// References: Zhang and Der Kiureghian (1995), IFIP WG 7.5, 297-304; Dutfoy and Lebrun (2007), Comptes Rendus Mecanique 335,
/// 297-304.
[[nodiscard]] FormResult form(const LimitState& g, Eigen::Index n, const FormOptions& options = {});

}  // namespace twindeck::reliability
