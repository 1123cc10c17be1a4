#include <cmath>
#include <complex>
#include <numbers>

#include "core/parallel.hpp"
#include "signal/fft.hpp"
#include "wind/simulation.hpp"

namespace twindeck::wind {

using Eigen::Index;

/// With f_ml = (l + m/n) df, l = 0 … n_waves - 1, m = 1 … n:
///     v_j(t) = Re sum_m exp(2 pi i m df t / n) sum_l A_jml exp(2 pi i l df t).
/// The inner sum has period T and is a transform; the factor before it has period n T.
Eigen::MatrixXd Simulator::sample_double_index(std::uint64_t seed) const {
  const Index n = field_.size();
  Eigen::MatrixXcd wave(n_waves_, n);
  for (Index m = 0; m < n; ++m) {
    double real[kLanes], imaginary[kLanes];
    for (Index l = 0; l < n_waves_; ++l) {
      if (l % kLanes == 0) waves(seed, m, l + 1, real, imaginary);
      wave(l, m) = {real[l % kLanes], imaginary[l % kLanes]};
    }
  }
  const double half = 0.5 * static_cast<double>(n_samples_);
  Eigen::MatrixXd velocity = Eigen::MatrixXd::Zero(n * n_samples_, n);
  struct Room {
    signal::RealFft fft;
    Eigen::VectorXcd bins;
  };
  const auto room = [this] { return Room{signal::RealFft(n_samples_), Eigen::VectorXcd::Zero(n_samples_ / 2 + 1)}; };
  parallel_for_with(n, room, [&](Room& own, Index j) {
    auto& [fft, bins] = own;
    for (Index m = 0; m <= j; ++m) {
      const double shift = static_cast<double>(m + 1) / static_cast<double>(n);
      for (Index l = 0; l < n_waves_; ++l) {
        const double f = (static_cast<double>(l) + shift) * df_;
        const double size = std::sqrt(2.0 * df_ * spectra(field_, f)[j]) * interpolated_row(f, j)[m];
        bins[l] = half * size * drift(field_, f)[j] * wave(l, m);
      }
      bins[0] *= 2.0;  // zero frequency stands in one bin, the others at +f and -f
      const Eigen::VectorXd real = fft.inverse(bins), imaginary = fft.inverse(std::complex<double>(0.0, -1.0) * bins);
      for (Index t = 0; t < velocity.rows(); ++t) {
        const double turn = 2.0 * std::numbers::pi * shift * df_ * static_cast<double>(t) / options_.rate_Hz;
        velocity(t, j) += real[t % n_samples_] * std::cos(turn) - imaginary[t % n_samples_] * std::sin(turn);
      }
    }
  });
  return velocity;
}

}  // namespace twindeck::wind
