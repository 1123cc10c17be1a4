#pragma once

#include <Eigen/Dense>
#include <array>
#include <complex>
#include <cstdint>
#include <numbers>

#include "unit/signal/noise.hpp"

/// The record that identification is timed and judged on: 16 channels x 60,000 samples at 20 Hz, 14 modes between 0.72 and 7.4
/// Hz with two close pairs, damping 0.6 to 1.1 %, white modal forces, 5 % sensor noise. Seed fixed.
namespace twindeck::bench {

constexpr double kRecordRate_Hz = 20.0;
constexpr std::array<double, 14> kRecordFrequencies_Hz = {0.72, 0.98, 1.05, 1.32, 1.68, 2.31, 2.36,
                                                          2.95, 3.40, 4.00, 4.70, 5.50, 6.40, 7.40};

inline double record_damping(std::size_t mode) { return 0.006 + 0.005 * static_cast<double>(mode * 5 % 14) / 13.0; }

/// Accelerations (n_samples × 16), each channel of unit mean square before the noise.
inline Eigen::MatrixXd identification_record(Eigen::Index n_samples = 60000, std::uint64_t seed = 20240901) {
  signal::test::Noise random(seed);
  constexpr Eigen::Index channels = 16;
  Eigen::MatrixXd data = Eigen::MatrixXd::Zero(n_samples, channels);
  for (std::size_t mode = 0; mode < kRecordFrequencies_Hz.size(); ++mode) {
    Eigen::RowVectorXd shape(channels);
    for (double& x : shape) x = random();
    const double omega = 2.0 * std::numbers::pi * kRecordFrequencies_Hz[mode], zeta = record_damping(mode);
    const std::complex<double> pole =
        std::exp(std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta)) * omega / kRecordRate_Hz);
    std::complex<double> state = 0.0;
    Eigen::VectorXd q(n_samples);
    for (Eigen::Index t = -4000; t < n_samples; ++t) {
      const double imaginary = random(), real = random();  // compilers choose the order of a call's arguments
      state = pole * state + std::complex<double>(real, imaginary);
      if (t >= 0) q[t] = state.real();
    }
    data += q / std::sqrt(q.squaredNorm() / static_cast<double>(n_samples)) * shape;
  }
  for (Eigen::Index c = 0; c < channels; ++c) {
    data.col(c) /= std::sqrt(data.col(c).squaredNorm() / static_cast<double>(n_samples));
    for (Eigen::Index t = 0; t < n_samples; ++t) data(t, c) += 0.05 * random();
  }
  return data;
}

}  // namespace twindeck::bench
