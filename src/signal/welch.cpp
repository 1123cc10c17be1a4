#include "signal/welch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.hpp"
#include "signal/fft.hpp"

namespace twindeck::signal {

using Eigen::Index;

namespace {

Eigen::VectorXd hann(Index n) {
  // The periodic window, whose shifted squares add up evenly.
  Eigen::VectorXd window(n);
  for (Index t = 0; t < n; ++t)
    window[t] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(t) / static_cast<double>(n));
  return window;
}

void check(Index n_samples, const WelchOptions& options) {
  if (options.segment < 8 || options.segment > n_samples) {
    throw InputError({"", 0, "segment"},
                     fmt::format("is {} samples, expected 8 to {}, the length of the record", options.segment, n_samples),
                     "give a shorter segment of the Welch average");
  }
  if (!(options.overlap >= 0.0 && options.overlap <= 0.95))
    throw InputError({"", 0, "overlap"}, fmt::format("is {}, expected a share in [0, 0.95]", options.overlap), "0.5 is usual");
}

/// Walks the segments: `use` is given the spectra of all channels (n_frequencies × n_channels). @return their number
Index for_each_segment(const Eigen::Ref<const Eigen::MatrixXd>& data, const WelchOptions& options,
                       const std::function<void(const Eigen::MatrixXcd&)>& use) {
  check(data.rows(), options);
  const Index n = options.segment;
  const Index step = std::max<Index>(1, static_cast<Index>(std::lround(static_cast<double>(n) * (1.0 - options.overlap))));
  const Eigen::VectorXd window = hann(n);
  RealFft fft(n);
  Eigen::MatrixXcd spectra(n / 2 + 1, data.cols());
  Index count = 0;
  for (Index start = 0; start + n <= data.rows(); start += step, ++count) {
    for (Index c = 0; c < data.cols(); ++c) {
      const auto piece = data.col(c).segment(start, n);
      const double mean = piece.mean();
      const Eigen::VectorXd windowed = (piece.array() - mean) * window.array();
      spectra.col(c) = fft.forward(windowed);
    }
    use(spectra);
  }
  return count;
}

/// (n_frequencies) c_m / (rate · sum w² · n_segments)
Eigen::VectorXd scaling(Index n, double rate_Hz, Index n_segments) {
  const double base = 1.0 / (rate_Hz * hann(n).squaredNorm() * static_cast<double>(n_segments));
  Eigen::VectorXd scale = Eigen::VectorXd::Constant(n / 2 + 1, 2.0 * base);
  scale[0] = base;
  if (n % 2 == 0) scale[n / 2] = base;
  return scale;
}

Eigen::VectorXd frequencies(Index n, double rate_Hz) {
  return Eigen::VectorXd::LinSpaced(n / 2 + 1, 0.0, static_cast<double>(n / 2)) * (rate_Hz / static_cast<double>(n));
}

}  // namespace

PowerSpectra power_spectra(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz, const WelchOptions& options) {
  PowerSpectra result;
  result.density = Eigen::MatrixXd::Zero(options.segment / 2 + 1, data.cols());
  result.n_segments = for_each_segment(data, options, [&](const Eigen::MatrixXcd& x) { result.density += x.cwiseAbs2(); });
  result.density.array().colwise() *= scaling(options.segment, rate_Hz, result.n_segments).array();
  result.frequency_Hz = frequencies(options.segment, rate_Hz);
  return result;
}

CrossSpectra cross_spectra(const Eigen::Ref<const Eigen::MatrixXd>& data, double rate_Hz, const WelchOptions& options) {
  CrossSpectra result;
  result.density.assign(static_cast<std::size_t>(options.segment / 2 + 1), Eigen::MatrixXcd::Zero(data.cols(), data.cols()));
  // The matrices of many channels are larger than any cache: each is fetched once for several segments, which take no more
  // memory together than the matrices.
  const auto together = static_cast<std::size_t>(std::min<Index>(16, data.cols()));
  std::vector<Eigen::MatrixXcd> waiting;  // (n_channels × n_frequencies) of a segment
  const auto add_waiting = [&] {
    for (std::size_t m = 0; m < result.density.size(); ++m) {
      for (const Eigen::MatrixXcd& x : waiting)
        result.density[m].noalias() += x.col(static_cast<Index>(m)) * x.col(static_cast<Index>(m)).adjoint();
    }
    waiting.clear();
  };
  result.n_segments = for_each_segment(data, options, [&](const Eigen::MatrixXcd& x) {
    waiting.emplace_back(x.transpose());
    if (waiting.size() == together) add_waiting();
  });
  add_waiting();
  const Eigen::VectorXd scale = scaling(options.segment, rate_Hz, result.n_segments);
  for (Index m = 0; m < scale.size(); ++m) result.density[static_cast<std::size_t>(m)] *= scale[m];
  result.frequency_Hz = frequencies(options.segment, rate_Hz);
  return result;
}

}  // namespace twindeck::signal
