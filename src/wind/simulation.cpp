#include "wind/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "core/error.hpp"
#include "core/random.hpp"
#include "signal/fft.hpp"
#include "wind/unit_wave.hpp"

namespace twindeck::wind {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Simulator::Simulator(FieldDefinition field, const SimulationOptions& options) : field_(std::move(field)), options_(options) {
  check(field_);
  n_samples_ = static_cast<Index>(std::llround(options_.duration_s * options_.rate_Hz));
  const double half = 0.5 * options_.rate_Hz;
  const double cutoff = options_.cutoff_Hz == 0.0 ? half : options_.cutoff_Hz;
  df_ = n_samples_ > 0 ? options_.rate_Hz / static_cast<double>(n_samples_) : 0.0;
  n_waves_ = df_ > 0.0 ? static_cast<Index>(std::ceil(cutoff / df_ * (1.0 - 1e-12))) - 1 : 0;
  if (n_waves_ < 2 || cutoff > half || options_.anchors < 0 || options_.anchors == 1) {
    throw InputError(
        {"", 0, "wind simulation"},
        fmt::format("is asked for {} s at {} Hz with waves up to {} Hz and {} anchors, expected at least two waves below "
                    "half the rate, and no anchors or at least two",
                    options_.duration_s, options_.rate_Hz, cutoff, options_.anchors),
        "lengthen the record or raise the rate");
  }

  const Index n_anchors = options_.anchors == 0 ? n_waves_ : std::min<Index>(options_.anchors, n_waves_);
  const bool every = options_.indexing == Indexing::single_index && n_anchors == n_waves_;
  // Double indexing reaches from df/n to (n_waves + 1) df.
  const double lowest = options_.indexing == Indexing::single_index ? df_ : df_ / static_cast<double>(field_.size());
  const double highest = df_ * static_cast<double>(n_waves_ + (options_.indexing == Indexing::single_index ? 0 : 1));
  for (Index a = 0; a < n_anchors; ++a) {
    const double part = static_cast<double>(a) / static_cast<double>(n_anchors - 1);
    anchor_Hz_.push_back(every ? df_ * static_cast<double>(a + 1) : lowest * std::pow(highest / lowest, part));
  }
  anchor_Hz_.back() = highest;
  for (const double f : anchor_Hz_) factor_.push_back(coherence_factor(field_, f));

  first_wave_.assign(anchor_Hz_.size(), n_waves_ + 1);
  for (Index l = n_waves_; l >= 1; --l) {
    first_wave_[static_cast<std::size_t>(bracket(df_ * static_cast<double>(l)).lower)] = l;
  }
  for (std::size_t a = first_wave_.size() - 1; a > 0; --a) first_wave_[a - 1] = std::min(first_wave_[a - 1], first_wave_[a]);
}

Simulator::Bracket Simulator::bracket(double f_Hz) const {
  const auto above = std::upper_bound(anchor_Hz_.begin(), anchor_Hz_.end(), f_Hz * (1.0 + 1e-12));
  const Index last = static_cast<Index>(anchor_Hz_.size()) - 2;
  const Index lower = std::clamp<Index>(above - anchor_Hz_.begin() - 1, 0, last);
  const double low = anchor_Hz_[static_cast<std::size_t>(lower)], high = anchor_Hz_[static_cast<std::size_t>(lower) + 1];
  return {lower, std::clamp(std::log(f_Hz / low) / std::log(high / low), 0.0, 1.0)};
}

Eigen::RowVectorXd Simulator::interpolated_row(double f_Hz, Index j) const {
  const Bracket at = bracket(f_Hz);
  const auto a = static_cast<std::size_t>(at.lower);
  return ((1.0 - at.share) * factor_[a].row(j) + at.share * factor_[a + 1].row(j)).normalized();
}

MatrixXd Simulator::amplitude_factor(Index l) const {
  const double f = df_ * static_cast<double>(l);
  MatrixXd factor(field_.size(), field_.size());
  for (Index j = 0; j < factor.rows(); ++j) factor.row(j) = interpolated_row(f, j);
  return spectra(field_, f).cwiseSqrt().asDiagonal() * factor;
}

/// Random waves exp(i phi_ml), or complex normal numbers of unit mean square, l = first, first + 1, …
/// @return (2 count × n) real parts, then imaginary parts
MatrixXd Simulator::waves(std::uint64_t seed, Index first, Index count) const {
  MatrixXd wave(2 * count, field_.size());
  VectorXd turns(count);
  for (Index m = 0; m < wave.cols(); ++m) {
    const auto stream = static_cast<std::uint64_t>(field_.component) << 32 | static_cast<std::uint64_t>(m);
    for (Index i = 0; i < count; ++i) turns[i] = uniform_number(seed, stream, 2 * static_cast<std::uint64_t>(first + i));
    double *real = wave.col(m).data(), *imaginary = real + count;
    for (Index i = 0; i < count; ++i) unit_wave(turns[i], real[i], imaginary[i]);
    if (options_.amplitudes == Amplitudes::fixed) continue;
    for (Index i = 0; i < count; ++i) {
      const double size =
          std::sqrt(-std::log(1.0 - uniform_number(seed, stream, 2 * static_cast<std::uint64_t>(first + i) + 1)));
      real[i] *= size;
      imaginary[i] *= size;
    }
  }
  return wave;
}

/// sqrt(2 df) sum_m H_jm exp(i phi_ml) of the waves of one bracket, into rows first - 1 … of `spectrum`.
void Simulator::add_bracket(std::uint64_t seed, std::size_t a, Index first, Index count, MatrixXcd& spectrum) const {
  // L is real: the product is done on real and imaginary parts stacked, with the factor at the anchor below and the one above.
  const MatrixXd wave = waves(seed, first, count);
  const MatrixXd below = wave * factor_[a].transpose().triangularView<Eigen::Upper>();
  const MatrixXd above = wave * factor_[a + 1].transpose().triangularView<Eigen::Upper>();
  const VectorXd cosine =
      factor_[a].cwiseProduct(factor_[a + 1]).rowwise().sum();  // of the angle between the two rows of a point
  VectorXd share(count), amplitude(count), c = VectorXd::Ones(count), s = VectorXd::Zero(count);
  for (Index i = 0; i < count; ++i) share[i] = bracket(df_ * static_cast<double>(first + i)).share;
  const double per_metre = df_ / field_.speed_m_s.mean();  // turns of wave l = 1 a metre along the wind
  for (Index j = 0; j < field_.size(); ++j) {
    if (j == 0 || !field_.same_turbulence(j, j - 1)) {
      for (Index i = 0; i < count; ++i) {
        amplitude[i] = std::sqrt(2.0 * df_ * field_.spectrum(j, df_ * static_cast<double>(first + i)));
      }
    }
    if (field_.frozen) {
      const double x = field_.position_m(j, 0) * per_metre, sign = x < 0.0 ? 1.0 : -1.0;
      for (Index i = 0; i < count; ++i) {
        unit_wave(std::abs(x) * static_cast<double>(first + i), c[i], s[i]);
        s[i] *= sign;
      }
    }
    const double *low = below.col(j).data(), *high = above.col(j).data();
    auto* out = reinterpret_cast<double*>(&spectrum(first - 1, j));
    for (Index i = 0; i < count; ++i) {
      const double t = share[i], r = 1.0 - t;
      const double size = amplitude[i] / std::sqrt(r * r + t * t + 2.0 * r * t * cosine[j]);  // rows back to length one
      const double real = size * (r * low[i] + t * high[i]), imaginary = size * (r * low[count + i] + t * high[count + i]);
      out[2 * i] = c[i] * real - s[i] * imaginary;
      out[2 * i + 1] = c[i] * imaginary + s[i] * real;
    }
  }
}

/// Amplitudes of every wave and point. @return (n_waves × n), row l - 1
MatrixXcd Simulator::point_spectra(std::uint64_t seed) const {
  MatrixXcd spectrum(n_waves_, field_.size());
  const auto n_brackets = static_cast<Index>(factor_.size()) - 1;
#pragma omp parallel for schedule(dynamic)
  for (Index b = n_brackets - 1; b >= 0; --b) {  // the largest first
    const auto a = static_cast<std::size_t>(b);
    const Index end = b + 1 < n_brackets ? first_wave_[a + 1] : n_waves_ + 1;
    for (Index first = first_wave_[a]; first < end; first += 256) {  // pieces that stay in the cache
      add_bracket(seed, a, first, std::min<Index>(256, end - first), spectrum);
    }
  }
  return spectrum;
}

MatrixXd Simulator::sample(std::uint64_t seed) const {
  if (options_.indexing == Indexing::double_index) return sample_double_index(seed);
  const MatrixXcd spectrum = point_spectra(seed);
  MatrixXd velocity(n_samples_, field_.size());
#pragma omp parallel
  {
    signal::RealFft fft(n_samples_);
    Eigen::VectorXcd bins = Eigen::VectorXcd::Zero(n_samples_ / 2 + 1);
#pragma omp for schedule(static)
    for (Index j = 0; j < field_.size(); ++j) {
      // A cosine of amplitude a is a/2 in the bins of +f and -f; the inverse transform divides by the number of samples.
      bins.segment(1, n_waves_) = 0.5 * static_cast<double>(n_samples_) * spectrum.col(j);
      velocity.col(j) = fft.inverse(bins);
    }
  }
  return velocity;
}

}  // namespace twindeck::wind
