#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::sysid {

/// Frequency and damping at one level of motion.
struct AmplitudePoint {
  double amplitude = 0.0;  ///< mean of the modal coordinate's envelope in the band, in the record's unit at the largest
                           ///< component of the shape
  double frequency_Hz = 0.0, frequency_std_Hz = 0.0;
  double damping_ratio = 0.0, damping_ratio_std = 0.0;
  double seconds = 0.0;  ///< of record in the band
};

/// Coordinate of one mode from many channels: least squares on its shape (largest component 1), then a zero-phase band-pass
/// with cosine flanks around its frequency, as the analytic signal q(t) = A(t) e^(i theta(t)).
/// @param data (n_samples × n_channels) @param shape (n_channels) real part is used
/// @param half_width_Hz  the pass band is f ± half of this; each flank is as wide as this
/// @return (n_samples) complex
[[nodiscard]] Eigen::VectorXcd modal_coordinate(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz,
                                                const Eigen::VectorXcd& shape, double frequency_Hz, double half_width_Hz);

/// Frequency and damping against amplitude in a free decay: in each band of the envelope (bands of equal ratio, from the
/// largest value down to three times the noise) straight lines are fitted to the phase and to ln A over time,
///
///     d theta/dt = 2 pi f_d,   d ln A/dt = -zeta 2 pi f,   f = f_d / sqrt(1 - zeta²),
///
/// Standard deviations follow from the scatter of the residuals, which are correlated over the memory of the filter.
/// @param coordinate  from modal_coordinate, from the release on @param memory_s  1/half_width of the filter
/// @param n_bands     bands of amplitude @param noise  RMS of the envelope without motion, 0 if unknown
/// Reference: Feldman (1994), Mechanical Systems and Signal Processing 8(2), 119-127 (FREEVIB).
[[nodiscard]] std::vector<AmplitudePoint> decay_by_amplitude(const Eigen::VectorXcd& coordinate, double rate_Hz,
                                                             double memory_s, int n_bands, double noise);

}  // namespace twindeck::sysid
