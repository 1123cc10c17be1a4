#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::identification {

/// Frequency and damping at one level of motion.
struct AmplitudePoint {
  /// Mean of the modal coordinate's envelope in the band. Its unit is that of the record. It is the amplitude at the channel
  /// with the largest component of the shape.
  double amplitude = 0.0;
  double frequency_Hz = 0.0, frequency_std_Hz = 0.0;
  double damping_ratio = 0.0, damping_ratio_std = 0.0;
  double seconds = 0.0;  ///< [s] length of the part of the record in the band
};

/// Coordinate of one mode from many channels, as the analytic signal q(t) = A(t) e^(i theta(t)). It is computed by least
/// squares on the shape of the mode (largest component 1). A zero-phase band-pass filter with cosine flanks around the
/// frequency of the mode follows.
/// @param data (n_samples × n_channels) @param shape (n_channels) real part is used
/// @param half_width_Hz  the pass band is f ± half_width_Hz/2; each flank has the width half_width_Hz
/// @return (n_samples) complex
[[nodiscard]] Eigen::VectorXcd modal_coordinate(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz,
                                                const Eigen::VectorXcd& shape, double frequency_Hz, double half_width_Hz);

/// Coordinate of a mode that decays freely.
struct DecayingCoordinate {
  Eigen::VectorXcd value;  ///< (n) as of modal_coordinate, from the beginning of the record until the decay meets the noise
  /// A third of the RMS over the last tenth of the record. In a short record this includes remaining motion.
  double noise = 0.0;
};
/// Modal coordinate of a mode that decays freely, without the ringing of the filter at both ends of the record. The signal is
/// multiplied by e^((zeta - i) 2 pi f t) with the known frequency and damping, which turns a linear decay into a constant. Then
/// follows a moving mean over the existing samples, with the weights of the filter. It keeps a constant, also at the ends. The
/// record is read until the decay meets the noise, because later noise would be magnified.
/// @param frequency_Hz, damping_ratio  known values of the mode; their error leaves a slow change, which the filter passes
///         Reference: Knutsson and Westin (1993), Computer Vision and Pattern Recognition, 515-523 (normalised convolution).
[[nodiscard]] DecayingCoordinate decaying_coordinate(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz,
                                                     const Eigen::VectorXcd& shape, double frequency_Hz, double damping_ratio,
                                                     double half_width_Hz);

/// Frequency and damping against amplitude in a free decay. The envelope is divided into bands of equal ratio, from its largest
/// value down to three times the noise. In each band, straight lines over time are fitted to the phase and to ln A:
///
///     d theta/dt = 2 pi f_d,   d ln A/dt = -zeta 2 pi f,   f = f_d / sqrt(1 - zeta²),
///
/// Standard deviations are computed from the residuals of the lines. Residuals are correlated over the memory of the filter,
/// and the standard deviations take this into account.
/// @param coordinate  from decaying_coordinate, from the release on @param memory_s  1/half_width of the filter
/// @param n_bands     bands of amplitude @param noise  RMS of the envelope without motion, 0 if unknown
/// Reference: Feldman (1994), Mechanical Systems and Signal Processing 8(2), 119-127 (FREEVIB).
[[nodiscard]] std::vector<AmplitudePoint> decay_by_amplitude(const Eigen::VectorXcd& coordinate, double rate_Hz,
                                                             double memory_s, int n_bands, double noise);

}  // namespace twindeck::identification
