#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::signal {

struct WelchOptions {
  Eigen::Index segment = 4096;  ///< samples a segment; frequency spacing = rate / segment
  double overlap = 0.5;         ///< share of a segment that the next one repeats, in [0, 0.95]
};

/// One-sided spectral densities per Hz: the integral of a power spectrum over 0 … rate/2 is the mean square of the signal.
struct PowerSpectra {
  Eigen::VectorXd frequency_Hz;  ///< (segment/2 + 1) from 0
  Eigen::MatrixXd density;       ///< (n_frequencies × n_channels) [unit²/Hz]
  Eigen::Index n_segments = 0;   ///< averages; with half overlap the relative deviation is about sqrt(11/(9 n_segments))
};
struct CrossSpectra {
  Eigen::VectorXd frequency_Hz;
  std::vector<Eigen::MatrixXcd> density;  ///< at each frequency (n_channels × n_channels), S_ij = E[X_i conj(X_j)], Hermitian
  Eigen::Index n_segments = 0;
};

/// Welch's average of modified periodograms, Hann window w, the mean of each segment removed:
///
///     S_ij(f_m) = c_m / (rate · sum w²) · mean over segments of X_i(m) conj(X_j(m)),   c_m = 2 but 1 at 0 and rate/2.
///
/// @param data     [unit] (n_samples × n_channels) @param rate_Hz  sampling rate
/// @throws InputError  if the segment is longer than the record or shorter than 8, or the overlap lies outside [0, 0.95]
/// Reference: Welch (1967), IEEE Trans. Audio Electroacoust. 15, 70-73.
[[nodiscard]] PowerSpectra power_spectra(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz,
                                         const WelchOptions& options);
[[nodiscard]] CrossSpectra cross_spectra(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz,
                                         const WelchOptions& options);

}  // namespace twindeck::signal
