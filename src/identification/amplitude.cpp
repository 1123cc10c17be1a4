#include "identification/amplitude.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "signal/fft.hpp"

namespace twindeck::identification {

using Eigen::Index;
using std::numbers::pi;

namespace {

constexpr Index kLastPart = 10;         ///< the last 1/kLastPart of a record gives its noise; most decays have ended by then
constexpr Index kFewestOfLastPart = 8;  ///< [samples] an RMS of fewer samples is random
constexpr double kMotionInLastPart =
    3.0;  ///< [-] assumed ratio of the RMS there to the noise: some motion may remain (DecayingCoordinate)

/// 1 within half the width of the centre, 0 beyond three halves, a cosine flank between.
double window(double offset, double half_width) {
  const double x = (std::abs(offset) - 0.5 * half_width) / half_width;
  if (x <= 0.0) return 1.0;
  return x >= 1.0 ? 0.0 : 0.5 + 0.5 * std::cos(pi * x);
}

/// Coordinate of a mode by least squares on its shape, with the largest component scaled to 1.
Eigen::VectorXd by_shape(const Eigen::Ref<const Eigen::MatrixXd>& data, const Eigen::VectorXcd& shape) {
  TWINDECK_ASSERT(shape.size() == data.cols() && data.rows() >= 8);
  Eigen::VectorXd weights = shape.real();
  weights /= weights.cwiseAbs().maxCoeff();
  return data * weights / weights.squaredNorm();
}

/// Samples after which a decay is below the noise.
Index samples_of_decay(double top, double noise, double decay_per_sample, Index n_samples) {
  if (!(decay_per_sample > 0.0) || !(noise > 0.0)) return n_samples;
  const double samples = std::log(std::max(top / noise, 2.0)) / decay_per_sample;
  return samples < static_cast<double>(n_samples) ? std::max<Index>(8, static_cast<Index>(samples)) : n_samples;
}

struct FittedLine {
  double slope = 0.0, deviation = 0.0;
};

/// Least squares over samples one step apart; for the deviation, one residual in `memory` samples counts as independent.
FittedLine fitted_line(const Eigen::VectorXd& y, double step, double memory) {
  const auto n = static_cast<double>(y.size());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(y.size(), -0.5 * (n - 1.0), 0.5 * (n - 1.0)) * step;
  FittedLine line;
  line.slope = x.dot(y) / x.squaredNorm();
  const double residual = (y.array() - y.mean() - line.slope * x.array()).square().sum();
  const double independent = std::max(3.0, n / std::max(memory, 1.0));
  line.deviation = std::sqrt(residual / n * independent / (independent - 2.0) / x.squaredNorm() * n / independent);
  return line;
}

}  // namespace

Eigen::VectorXcd modal_coordinate(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz, const Eigen::VectorXcd& shape,
                                  double frequency_Hz, double half_width_Hz) {
  const Eigen::VectorXd q = by_shape(data, shape);
  // Zeros follow the record, so that the filter does not connect its end with its beginning.
  const Index n = q.size(), size = signal::fast_fft_size(n + static_cast<Index>(2.0 * rate_Hz / half_width_Hz));
  signal::RealFft fft(size);
  Eigen::VectorXcd spectrum = fft.forward(q);
  const double line_Hz = rate_Hz / static_cast<double>(size);
  for (Index m = 0; m < spectrum.size(); ++m)
    spectrum[m] *= window(static_cast<double>(m) * line_Hz - frequency_Hz, half_width_Hz);
  // Real part by the inverse transform; the imaginary part (Hilbert transform) from the spectrum turned by -90 degrees.
  const Eigen::VectorXd real = fft.inverse(spectrum);
  spectrum *= std::complex<double>(0.0, -1.0);
  const Eigen::VectorXd imag = fft.inverse(spectrum);
  Eigen::VectorXcd analytic(n);
  for (Index t = 0; t < n; ++t) analytic[t] = {real[t], imag[t]};
  return analytic;
}

DecayingCoordinate decaying_coordinate(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz,
                                       const Eigen::VectorXcd& shape, double frequency_Hz, double damping_ratio,
                                       double half_width_Hz) {
  DecayingCoordinate coordinate;
  const Eigen::VectorXcd filtered = modal_coordinate(data, rate_Hz, shape, frequency_Hz, half_width_Hz);
  const Index tail = std::max(kFewestOfLastPart, filtered.size() / kLastPart);
  coordinate.noise = std::sqrt(filtered.tail(tail).squaredNorm() / static_cast<double>(tail)) / kMotionInLastPart;
  const std::complex<double> turn = std::complex<double>(damping_ratio, -1.0) * 2.0 * pi * frequency_Hz / rate_Hz;
  const Index n = samples_of_decay(filtered.cwiseAbs().maxCoeff(), coordinate.noise, turn.real(), data.rows());
  const Eigen::VectorXd q = by_shape(data, shape).head(n);
  Eigen::VectorXcd still(n);
  for (Index t = 0; t < n; ++t) still[t] = 2.0 * q[t] * std::exp(turn * static_cast<double>(t));
  // Zeros follow the record, over the filter's memory at both ends.
  const Index size = signal::fast_fft_size(n + static_cast<Index>(4.0 * rate_Hz / half_width_Hz));
  signal::RealFft fft(size);
  const double line_Hz = rate_Hz / static_cast<double>(size);
  const auto slow = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXcd spectrum = fft.forward(x);
    for (Index m = 0; m < spectrum.size(); ++m) spectrum[m] *= window(static_cast<double>(m) * line_Hz, half_width_Hz);
    return Eigen::VectorXd(fft.inverse(spectrum).head(n));
  };
  const Eigen::VectorXd weight = slow(Eigen::VectorXd::Ones(n)), real = slow(still.real()), imag = slow(still.imag());
  coordinate.value.resize(n);
  for (Index t = 0; t < n; ++t)
    coordinate.value[t] = std::complex<double>(real[t], imag[t]) / weight[t] * std::exp(-turn * static_cast<double>(t));
  return coordinate;
}

std::vector<AmplitudePoint> decay_by_amplitude(const Eigen::VectorXcd& coordinate, double rate_Hz, double memory_s, int n_bands,
                                               double noise) {
  TWINDECK_ASSERT(n_bands >= 1 && coordinate.size() >= 8);
  const Index n = coordinate.size();
  Eigen::VectorXd envelope = coordinate.cwiseAbs(), phase(n);
  phase[0] = std::arg(coordinate[0]);
  for (Index t = 1; t < n; ++t) phase[t] = phase[t - 1] + std::arg(coordinate[t] * std::conj(coordinate[t - 1]));
  // The first moments are left out, because the filter's memory spoils them. The decay ends where it meets the noise.
  const auto memory = static_cast<Index>(std::ceil(memory_s * rate_Hz));
  Index begin = std::min<Index>(memory, n / 4), end = n;
  envelope.segment(begin, std::max<Index>(1, std::min(n - begin, 2 * memory))).maxCoeff(&begin);
  begin += std::min<Index>(memory, n / 4);
  const double top = envelope[begin], floor = std::max(3.0 * noise, 1e-3 * top);
  for (Index t = begin; t < n; ++t) {
    if (envelope[t] < floor) {
      end = t;
      break;
    }
  }
  end = std::min(end, n - std::min<Index>(memory, n / 4));
  std::vector<AmplitudePoint> points;
  if (end - begin < 2 * std::max<Index>(memory, 4)) return points;
  const double bottom = std::max(envelope.segment(begin, end - begin).minCoeff(), floor);
  const double ratio = std::pow(bottom / top, 1.0 / n_bands);
  for (int band = 0; band < n_bands; ++band) {
    const double high = top * std::pow(ratio, band), low = top * std::pow(ratio, band + 1);
    // A decay passes each level once: from the last sample above the upper one to the first below the lower one.
    Index from = begin, to = end;
    for (Index t = begin; t < end; ++t)
      if (envelope[t] > high) from = t;
    for (Index t = from + 1; t < end; ++t) {
      if (envelope[t] < low) {
        to = t;
        break;
      }
    }
    if (to - from < std::max<Index>(memory, 8)) continue;
    const FittedLine turning = fitted_line(phase.segment(from, to - from), 1.0 / rate_Hz, static_cast<double>(memory));
    const FittedLine decay =
        fitted_line(envelope.segment(from, to - from).array().log().matrix(), 1.0 / rate_Hz, static_cast<double>(memory));
    const double omega = std::hypot(turning.slope, decay.slope);
    points.push_back({.amplitude = envelope.segment(from, to - from).mean(),
                      .frequency_Hz = omega / (2.0 * pi),
                      .frequency_std_Hz = turning.deviation / (2.0 * pi),
                      .damping_ratio = -decay.slope / omega,
                      .damping_ratio_std = decay.deviation / omega,
                      .seconds = static_cast<double>(to - from) / rate_Hz});
  }
  return points;
}

}  // namespace twindeck::identification
