#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace twindeck::signal {

/// Surrogate record with the spectra and cross-spectra of `record` and random phases: one angle per line, the same for all
/// channels. The sum of the lines is taken as one period. It suits stationary, nearly normal noise with any spectrum.
/// @param record  (n_samples × n_channels) without mean @param draw  number of the draw @return the same size
/// Reference: Prichard and Theiler (1994), Physical Review Letters 73(7), 951-954.
[[nodiscard]] Eigen::MatrixXd surrogate_noise(const Eigen::MatrixXd& record, std::uint64_t seed, std::uint64_t draw);

}  // namespace twindeck::signal
