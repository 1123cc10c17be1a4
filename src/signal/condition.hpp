#pragma once

#include <Eigen/Core>

namespace twindeck::signal {

/// Removes the least-squares straight line from each channel. @param data (n_samples × n_channels) @return same shape
[[nodiscard]] Eigen::MatrixXd detrended(const Eigen::Ref<const Eigen::MatrixXd>& data);

/// [samples] of a decimated record that its filter reaches: so far from its ends the continuation has no part in them.
constexpr Eigen::Index decimation_reach = 26;

/// Keeps every `factor`-th sample after a linear-phase low-pass (Kaiser-windowed sinc, centred: no phase shift). Passband to
/// 0.8 of the new Nyquist frequency within 1e-4, at least 80 dB down from the new Nyquist frequency on. The record is continued
/// at its ends by its point reflection, so that a straight line passes unchanged.
/// @param data (n_samples × n_channels) @param factor >= 1; 1 returns the data as they are
/// @return (ceil(n_samples / factor) × n_channels), first sample at the time of the first sample
/// @throws InputError  if the record is shorter than the filter (about 51 factor samples)
/// Reference: Kaiser (1974), Proc. IEEE Int. Symp. Circuits and Systems, 20-23.
[[nodiscard]] Eigen::MatrixXd decimated(const Eigen::Ref<const Eigen::MatrixXd>& data, Eigen::Index factor);

}  // namespace twindeck::signal
