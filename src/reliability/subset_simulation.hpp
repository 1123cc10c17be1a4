#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/error.hpp"
#include "reliability/form.hpp"

namespace twindeck::reliability {

struct SubsetOptions {
  int samples = 2000;        ///< of each level
  double level_share = 0.1;  ///< p0: share of the samples that a level keeps
  int largest_levels = 20;   ///< probabilities below p0 to this power are not reached
  std::uint64_t seed = 1;
};

struct SubsetResult {
  Status status;  ///< not converged: the limit was not reached in `largest_levels`
  double probability = 0.0;
  double variation = 0.0;  ///< [-] coefficient of variation, from the correlation within the chains of each level
  int levels = 0, calls = 0;
  Eigen::MatrixXd failed;  ///< (n × m) samples of the last level that exceed the limit
};

/// Subset simulation with adaptive conditional sampling: P(g <= 0) as a product of shares p0 of levels g <= b_1 > b_2 > ... >
/// 0. Chains of a level move by u' = rho u + sqrt(1 - rho²) xi, whose deviation is adapted to an acceptance of 0.44. The seeds
/// are in random order. Known failure: if g falls towards one failure region faster than towards a more probable one, all
/// chains leave the more probable one. Neither the estimate nor its variation shows this. `form` from several starts shows a
/// region that no sample is in; `hidden_region` compares the two. Variations below assume independent levels.
/// @throws InputError  if all samples of the first level exceed the limit
/// References: Au and Beck (2001), Prob. Eng. Mech. 16, 263-277; Papaioannou et al. (2015), Prob. Eng. Mech. 41, 89-103;
/// Breitung (2019), Rel. Eng. Syst. Safety 182, 98-104 (failures).
[[nodiscard]] SubsetResult subset_simulation(const LimitState& g, Eigen::Index n, const SubsetOptions& options = {});

/// Whether a failure region that FORM found is more probable than the subset estimate. Its probability beyond the tangent plane
/// of the design point is Phi(-beta) times the share of 200 samples there that exceed the limit. The function returns true if
/// this is above the estimate by three standard deviations of the logarithm. It calls g 200 times.
/// @param design_point  (n) u of FORM, not the origin, where g > 0
[[nodiscard]] bool hidden_region(const SubsetResult& subset, const LimitState& g,
                                 const Eigen::Ref<const Eigen::VectorXd>& design_point, std::uint64_t seed = 1);

}  // namespace twindeck::reliability
