#pragma once

#include <Eigen/Core>

#include "signal/welch.hpp"

namespace twindeck::identification {

/// Singular values and first singular vectors of the cross spectral matrix, line by line: frequency domain decomposition.
struct SingularSpectra {
  Eigen::VectorXd frequency_Hz;    ///< (n_lines)
  Eigen::MatrixXd values;          ///< (n_lines × n_values) descending, one-sided, in the square of the records' unit per Hz
  Eigen::MatrixXcd first_vectors;  ///< (n_channels × n_lines) unit norm
};
[[nodiscard]] SingularSpectra singular_spectra(const signal::CrossSpectra& spectra, Eigen::Index n_values);

struct EfddMode {
  bool found = false;  ///< false if the mode has too few lines or periods
  double frequency_Hz = 0.0, damping_ratio = 0.0;
  Eigen::VectorXcd shape;  ///< (n_channels) at the peak
};

/// Enhanced frequency domain decomposition near a frequency. It finds the peak of the first singular value within ±`search`.
/// The lines around the peak whose first singular vector has a MAC of at least `mac` with that of the peak form the bell. The
/// inverse Fourier transform of the bell is the free decay of one oscillator. Straight lines are fitted to its phase and its
/// logarithmic envelope between 0.9 and 0.3 of the start.
/// Use it as a cross-check: the Welch window biases the damping upwards by about 1.5/(pi T f) for segments of T seconds.
/// Reference: Brincker, Ventura and Andersen (2001), IMAC 19.
[[nodiscard]] EfddMode efdd(const SingularSpectra& spectra, double frequency_Hz, double search = 0.02, double mac = 0.8);

}  // namespace twindeck::identification
