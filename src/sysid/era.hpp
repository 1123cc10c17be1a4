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
  Changes changes;     ///< of the Hankel matrix under what disturbs the samples, for pole_factors
  double noise = 0.0;  ///< standard deviation of what the largest model leaves of the decays, in their unit
};

/// Eigensystem realisation of free decays: O = U S^(1/2) of the block Hankel matrix, poles by the shift equation. Its changes are
/// `n_draws` draws of what disturbs the decays, carried through the same first-order formulas as the correlations' are: deviations
/// within 1/sqrt(2 n_draws) of their limit. On a structure that wind and traffic move all the time the disturbance is not the
/// sensors' white noise but ambient vibration, strongest at the very modes that decay, and the model takes part of it for decay:
/// what it leaves does not tell how strong it is. Records of the same sensors at rest do.
/// @param orders ascending @param seed  of the draws
/// @param quiet  records (n_samples × n_outputs) without decay, each at least as long as the decays: a draw is one of them in turn
///               with its phases drawn anew. Without any, white noise of the strength of what the largest model leaves
/// @throws InputError  if the decays are too short for the largest order
/// Reference: Juang and Pappa (1985), Journal of Guidance, Control, and Dynamics 8(5), 620-627.
[[nodiscard]] FreeDecay era(const std::vector<Eigen::MatrixXd>& decays, Eigen::Index block_rows, const std::vector<int>& orders, double rate_Hz,
                            std::uint64_t seed, int n_draws = 100, const std::vector<Eigen::MatrixXd>& quiet = {});

}  // namespace twindeck::sysid
