#include "signal/surrogate_noise.hpp"

#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "core/random.hpp"
#include "signal/fft.hpp"

namespace twindeck::signal {

Eigen::MatrixXd surrogate_noise(const Eigen::MatrixXd& record, std::uint64_t seed, std::uint64_t draw) {
  TWINDECK_ASSERT(record.rows() >= 2);
  const Eigen::Index n = record.rows(), lines = (n - 1) / 2;  // with a partner of negative frequency
  RealFft fft(n);
  Eigen::MatrixXd other(n, record.cols());
  for (Eigen::Index c = 0; c < record.cols(); ++c) {
    Eigen::VectorXcd spectrum = fft.forward(record.col(c));
    for (Eigen::Index m = 1; m <= lines; ++m)
      spectrum[m] *= std::polar(1.0, 2.0 * std::numbers::pi * uniform_number(seed, draw, static_cast<std::uint64_t>(m)));
    // Mean and, at even n, the line at the Nyquist frequency have no phase but a sign.
    if (n % 2 == 0 && uniform_number(seed, draw, 0) < 0.5) spectrum[n / 2] *= -1.0;
    other.col(c) = fft.inverse(spectrum);
  }
  return other;
}

}  // namespace twindeck::signal
