#include "buffeting/field_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "signal/welch.hpp"

namespace twindeck::buffeting {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Length of the spectra's segments. Longer ones are fewer, so their coherence scatters more. The limits below belong to it.
constexpr double kSegment_s = 64.0;
/// Limits for 20 seeds of 600 s: three standard deviations of the mean, at the worst of 60 points. Shorter runs scatter more.
constexpr double kLimitSeeds = 20.0, kLimitDuration_s = 600.0;
constexpr wind::PerComponent kSigmaLimit = {0.05, 0.03, 0.02};    ///< [-] of the standard deviations of v', u', w'
constexpr double kSpectrumLimit = 0.015, kCoherenceLimit = 0.05;  ///< [-] RMS over frequencies; over pairs and frequencies

}  // namespace

FieldStatistics::FieldStatistics(std::string event, const std::vector<wind::Simulator>& simulators, long seeds)
    : event_(std::move(event)), simulators_(simulators), seeds_(static_cast<std::size_t>(seeds)) {
  const wind::Simulator& along = simulators.front();
  // There is no wave at or above the cutoff, so every stride-th sample holds the whole signal.
  const double rate = static_cast<double>(along.n_samples()) * along.spacing_Hz();
  const double cutoff = static_cast<double>(along.n_waves() + 1) * along.spacing_Hz();
  stride_ = std::max<Index>(1, static_cast<Index>(rate / (2.0 * cutoff)));
  rate_Hz_ = rate / static_cast<double>(stride_);
  const auto segment = 2 * static_cast<Index>(std::llround(0.5 * kSegment_s * rate_Hz_));
  segment_ = std::min<Index>({1024, segment, along.n_samples() / stride_ / 8 * 2});
  const Index n = along.field().size();
  for (Index i = 0; i < 8 && i < n; ++i)
    chosen_.push_back(i * i * (n - 1) / 49);  // neighbours at first, then ever further apart
  chosen_.erase(std::unique(chosen_.begin(), chosen_.end()), chosen_.end());
}

void FieldStatistics::add(long seed, const Eigen::Ref<const MatrixXd>& gusts) {
  Seed& own = seeds_[static_cast<std::size_t>(seed)];
  own.mean_square = gusts.colwise().squaredNorm().transpose() / static_cast<double>(gusts.rows());
  const Index kinds = std::ssize(simulators_), n = gusts.cols() / kinds, samples = gusts.rows() / stride_;
  for (Index c = 0; c < kinds; ++c) {
    const Eigen::Map<const MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>> part(
        gusts.col(c * n).data(), samples, n, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>(gusts.outerStride(), stride_));
    const MatrixXd kept = part;
    own.density.push_back(signal::power_spectra(kept, rate_Hz_, {.segment = segment_}).density.rowwise().mean());
    own.cross.push_back(signal::cross_spectra(kept(Eigen::all, chosen_), rate_Hz_, {.segment = segment_}).density);
  }
}

std::vector<FieldCheck> FieldStatistics::checks() const {
  std::vector<FieldCheck> out;
  const wind::Simulator& any = simulators_.front();
  const double scatter = std::sqrt(kLimitSeeds * kLimitDuration_s * any.spacing_Hz() / static_cast<double>(seeds_.size()));
  for (std::size_t c = 0; c < simulators_.size(); ++c) {
    const wind::FieldDefinition& field = simulators_[c].field();
    const double limit = wind::of(kSigmaLimit, field.component);
    const std::string letter = wind::paper_letter(field.component);
    const Index n = field.size(), bins = static_cast<Index>(segment_ / 2 + 1);
    VectorXd mean_square = VectorXd::Zero(n), density = VectorXd::Zero(bins);
    std::vector<MatrixXcd> cross(static_cast<std::size_t>(bins), MatrixXcd::Zero(std::ssize(chosen_), std::ssize(chosen_)));
    for (const Seed& seed : seeds_) {
      mean_square += seed.mean_square.segment(static_cast<Index>(c) * n, n) / static_cast<double>(seeds_.size());
      density += seed.density[c] / static_cast<double>(seeds_.size());
      for (std::size_t i = 0; i < cross.size(); ++i) cross[i] += seed.cross[c][i];
    }
    double band = 0.0;
    for (Index l = 1; l <= any.n_waves(); ++l)
      band += field.spectrum(0, any.spacing_Hz() * static_cast<double>(l)) * any.spacing_Hz();
    const double target = std::sqrt(band);
    const VectorXd sigma = mean_square.cwiseSqrt();
    Index worst = 0;
    (sigma.array() - target).abs().maxCoeff(&worst);
    out.push_back({event_, "sigma_" + letter + "_mean_m_s", target, sigma.mean(), limit * scatter * target});
    out.push_back({event_, "sigma_" + letter + "_worst_point_m_s", target, sigma[worst], limit * scatter * target});

    double error = 0.0, difference = 0.0;
    Index pairs = 0;
    // Left out: the first bins and those next to the cutoff, because the window smears the spectrum there.
    const double cutoff = any.spacing_Hz() * static_cast<double>(any.n_waves());
    const Index first = 4, edge = static_cast<Index>(cutoff / rate_Hz_ * static_cast<double>(segment_)) - 3;
    const Index last = std::max(first, std::min(edge, bins - 3));
    for (Index i = first; i <= last; ++i) {
      const double f = rate_Hz_ * static_cast<double>(i) / static_cast<double>(segment_);
      error += std::pow(density[i] / field.spectrum(0, f) - 1.0, 2) / static_cast<double>(last - first + 1);
      const MatrixXd gamma = wind::coherence(field, f);
      const Eigen::VectorXcd phase = wind::drift(field, f);
      const MatrixXcd& s = cross[static_cast<std::size_t>(i)];
      for (Index a = 1; a < s.rows(); ++a) {
        for (Index b = 0; b < a; ++b, ++pairs) {
          const Index j = chosen_[static_cast<std::size_t>(a)], k = chosen_[static_cast<std::size_t>(b)];
          const double in_phase =
              (s(a, b) * std::conj(phase[j]) * phase[k]).real() / std::sqrt(s(a, a).real() * s(b, b).real());
          difference += std::pow(in_phase - gamma(j, k), 2);
        }
      }
    }
    out.push_back({event_, "psd_" + letter + "_relative_error", 0.0, std::sqrt(error), kSpectrumLimit * scatter});
    out.push_back({event_, "coherence_" + letter + "_error", 0.0,
                   std::sqrt(difference / static_cast<double>(std::max<Index>(pairs, 1))), kCoherenceLimit * scatter});
  }
  return out;
}

Interval confidence_interval(const Eigen::Ref<const Eigen::VectorXd>& replicates, double level) {
  const Eigen::Index n = replicates.size();
  if (n < 2)
    throw InputError({"", 0, "replicates"}, fmt::format("are {}, expected at least two for an interval", n),
                     "ask for more seeds");
  Interval out;
  out.mean = replicates.mean();
  out.deviation = std::sqrt((replicates.array() - out.mean).square().sum() / static_cast<double>(n - 1));
  const double half =
      student_quantile(static_cast<double>(n - 1), 0.5 * (1.0 + level)) * out.deviation / std::sqrt(static_cast<double>(n));
  out.low = out.mean - half;
  out.high = out.mean + half;
  return out;
}

}  // namespace twindeck::buffeting
