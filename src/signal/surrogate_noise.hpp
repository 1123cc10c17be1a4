#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace twindeck::signal {

/// A record that could have been measured as well: the channels' spectra and cross-spectra are those of `record`, the phases of
/// its lines are drawn anew (one angle a line, the same for all channels), and the sum of lines is read as one period. For
/// stationary, nearly normal noise of any colour.
/// @param record  (n_samples × n_channels) without mean @param draw  number of the draw @return the same size
/// Reference: Prichard and Theiler (1994), Physical Review Letters 73(7), 951-954.
[[nodiscard]] Eigen::MatrixXd surrogate_noise(const Eigen::MatrixXd& record, std::uint64_t seed, std::uint64_t draw);

}  // namespace twindeck::signal
