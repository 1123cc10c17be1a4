#include "signal/condition.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::signal {

using Eigen::Index;

namespace {

constexpr double kStopband_dB = 80.0;
constexpr double kPassband = 0.8;  // share of the new Nyquist frequency

/// Half of a symmetric low-pass, h[0] the centre; unit gain at frequency zero.
Eigen::VectorXd half_low_pass(Index factor) {
  const double pi = std::numbers::pi;
  const double nyquist = pi / static_cast<double>(factor);  // rad a sample
  const double width = (1.0 - kPassband) * nyquist;
  const double cutoff = nyquist - 0.5 * width;
  const auto half = static_cast<Index>(std::ceil((kStopband_dB - 8.0) / (2.285 * width) / 2.0));
  const double beta = 0.1102 * (kStopband_dB - 8.7);
  Eigen::VectorXd h(half + 1);
  for (Index k = 0; k <= half; ++k) {
    const double x = static_cast<double>(k), share = x / static_cast<double>(half);
    const double sinc = k == 0 ? cutoff / pi : std::sin(cutoff * x) / (pi * x);
    h[k] = sinc * std::cyl_bessel_i(0.0, beta * std::sqrt(1.0 - share * share)) / std::cyl_bessel_i(0.0, beta);
  }
  return h / (2.0 * h.sum() - h[0]);
}

/// The record with `pad` samples of its point reflection at both ends.
Eigen::VectorXd extended(const Eigen::Ref<const Eigen::VectorXd>& x, Index pad) {
  const Index n = x.size();
  Eigen::VectorXd y(n + 2 * pad);
  y.segment(pad, n) = x;
  for (Index k = 1; k <= pad; ++k) {
    y[pad - k] = 2.0 * x[0] - x[k];
    y[pad + n - 1 + k] = 2.0 * x[n - 1] - x[n - 1 - k];
  }
  return y;
}

}  // namespace

Eigen::MatrixXd detrended(const Eigen::Ref<const Eigen::MatrixXd>& data) {
  const Index n = data.rows();
  if (n < 2) return Eigen::MatrixXd::Zero(n, data.cols());
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  const Eigen::RowVectorXd mean = data.colwise().mean();
  const Eigen::RowVectorXd slope = time.transpose() * data / time.squaredNorm();
  return (data - time * slope).rowwise() - mean;
}

Eigen::MatrixXd decimated(const Eigen::Ref<const Eigen::MatrixXd>& data, Index factor) {
  TWINDECK_ASSERT(factor >= 1);
  if (factor == 1) return data;
  const Eigen::VectorXd half = half_low_pass(factor);
  const Index pad = half.size() - 1;
  if (data.rows() <= pad) {
    throw InputError({"", 0, "decimation"},
                     fmt::format("is {}, whose filter needs more than the {} samples of the record", factor, data.rows()),
                     "take a smaller factor or a longer record");
  }
  Eigen::VectorXd filter(2 * pad + 1);
  filter << half.tail(pad).reverse(), half;
  const Index kept = (data.rows() + factor - 1) / factor;
  Eigen::MatrixXd result(kept, data.cols());
  for (Index c = 0; c < data.cols(); ++c) {
    const Eigen::VectorXd x = extended(data.col(c), pad);
    for (Index k = 0; k < kept; ++k) result(k, c) = filter.dot(x.segment(k * factor, filter.size()));
  }
  return result;
}

}  // namespace twindeck::signal
