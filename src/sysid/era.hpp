#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sysid/state_space.hpp"
#include "sysid/uncertainty.hpp"

namespace twindeck::sysid {

/// Block Hankel matrix of free responses  H = [ Y_0 … Y_{q-1} ; Y_1 … Y_q ; … ],  Y_k the outputs (n_outputs × n_decays) at sample k.
/// @param decays  free responses (n_samples × n_outputs) that start at the release, all of one length
/// @param block_rows  p; the columns use the remaining samples, at most `block_columns`
[[nodiscard]] Eigen::MatrixXd block_hankel(const std::vector<Eigen::MatrixXd>& decays, Eigen::Index block_rows, Eigen::Index block_columns);

struct FreeDecay {
  Observability observability;
  ShiftModels models;
  Changes changes;     ///< of the Hankel matrix under the noise of the samples, for pole_factors
  double noise = 0.0;  ///< standard deviation of what the largest model leaves of the decays, in their unit
};

/// Eigensystem realisation of free decays: O = U S^(1/2) of the block Hankel matrix, poles by the shift equation. Its changes are
/// `n_draws` draws of white noise of the strength of what the model leaves, carried through the same first-order formulas as the
/// correlations' are: deviations within 1/sqrt(2 n_draws) of their limit.
/// @param orders ascending @param seed  of the draws
/// @throws InputError  if the decays are too short for the largest order
/// Reference: Juang and Pappa (1985), Journal of Guidance, Control, and Dynamics 8(5), 620-627.
[[nodiscard]] FreeDecay era(const std::vector<Eigen::MatrixXd>& decays, Eigen::Index block_rows, const std::vector<int>& orders, double rate_Hz,
                            std::uint64_t seed, int n_draws = 100);

}  // namespace twindeck::sysid
