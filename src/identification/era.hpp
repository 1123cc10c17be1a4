#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "identification/state_space.hpp"
#include "identification/uncertainty.hpp"

namespace twindeck::identification {

struct FreeDecay {
  Observability observability;
  ShiftModels models;
  Changes changes;     ///< changes of the Hankel matrix by the disturbance, for pole_factors
  double noise = 0.0;  ///< standard deviation of the residual of the largest model, in the unit of the decays
};

/// Eigensystem realisation of free decays: O = U S^(1/2) of the block Hankel matrix, poles by the shift equation. Its changes
/// are `n_draws` random draws of the disturbance, propagated by the same first-order formulas as for correlations. The relative
/// error of the standard deviations is 1/sqrt(2 n_draws). If wind and traffic move the structure all the time, the disturbance
/// is ambient vibration and not white noise of the sensors. It is strongest at the decaying modes, and the model fits part of
/// it as decay, so the residual of the model is too small. Records of the same sensors without a decay show its strength.
/// @param orders ascending @param seed  of the draws
/// @param quiet  records (n_samples × n_outputs) without decay, each at least as long as the decays: each draw is one of them
///         with random phases. If empty: white noise with the strength of the largest model's residual
/// @throws InputError  if the decays are too short for the largest order
/// Reference: Juang and Pappa (1985), Journal of Guidance, Control, and Dynamics 8(5), 620-627.
[[nodiscard]] FreeDecay era(const std::vector<Eigen::MatrixXd>& decays, Eigen::Index block_rows, const std::vector<int>& orders,
                            double rate_Hz, std::uint64_t seed, int n_draws = 100,
                            const std::vector<Eigen::MatrixXd>& quiet = {});

}  // namespace twindeck::identification
