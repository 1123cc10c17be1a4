#pragma once

#include <Eigen/Core>
#include <vector>

#include "signal/welch.hpp"

namespace twindeck::sysid {

/// Singular values and first singular vectors of the cross spectral matrix, line by line: frequency domain decomposition.
struct SingularSpectra {
  Eigen::VectorXd frequency_Hz;    ///< (n_lines)
  Eigen::MatrixXd values;          ///< (n_lines × n_values) descending, one-sided, in the square of the records' unit per Hz
  Eigen::MatrixXcd first_vectors;  ///< (n_channels × n_lines) unit norm
};
[[nodiscard]] SingularSpectra singular_spectra(const signal::CrossSpectra& spectra, Eigen::Index n_values);

struct EfddMode {
  bool found = false;              ///< false where too few lines or periods belong to the mode
  double frequency_Hz = 0.0, damping_ratio = 0.0;
  Eigen::VectorXcd shape;          ///< (n_channels) at the peak
};

/// Enhanced frequency domain decomposition about a frequency: the peak of the first singular value within ±`search` of it, the bell of
/// lines around it whose first singular vector has a MAC of at least `mac` with the peak's, its inverse Fourier transform as the free
/// decay of one oscillator, and straight lines through its phase and logarithmic envelope between 0.9 and 0.3 of the start. A
/// cross-check: the Welch window biases the damping upwards by about 1.5/(pi T f) for segments of T seconds.
/// Reference: Brincker, Ventura and Andersen (2001), IMAC 19.
[[nodiscard]] EfddMode efdd(const SingularSpectra& spectra, double frequency_Hz, double search = 0.02, double mac = 0.8);

}  // namespace twindeck::sysid
