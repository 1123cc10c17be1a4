#include "wind/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "signal/fft.hpp"

namespace twindeck::wind {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Simulator::Simulator(FieldDefinition field, const SimulationOptions& options) : field_(std::move(field)), options_(options) {
  check(field_);
  n_samples_ = static_cast<Index>(std::llround(options_.duration_s * options_.rate_Hz));
  const double half = 0.5 * options_.rate_Hz;
  const double cutoff = options_.cutoff_Hz == 0.0 ? half : options_.cutoff_Hz;
  df_ = n_samples_ > 0 ? options_.rate_Hz / static_cast<double>(n_samples_) : 0.0;
  n_waves_ = df_ > 0.0 ? static_cast<Index>(std::ceil(cutoff / df_ * (1.0 - 1e-12))) - 1 : 0;
  if (n_waves_ < 2 || cutoff > half || options_.anchors < 0 || options_.anchors == 1)
    throw InputError(
        {"", 0, "wind simulation"},
        fmt::format("is asked for {} s at {} Hz with waves up to {} Hz and {} anchors, expected at least two waves below "
                    "half the rate, and no anchors or at least two",
                    options_.duration_s, options_.rate_Hz, cutoff, options_.anchors),
        "lengthen the record or raise the rate");

  const bool is_double = options_.frequencies == Frequencies::double_indexed;
  n_lines_ = is_double ? n_waves_ * field_.size() : n_waves_;
  line_Hz_ = is_double ? df_ / static_cast<double>(field_.size()) : df_;
  const Index n_anchors = options_.anchors == 0 ? n_lines_ : std::min<Index>(options_.anchors, n_lines_);
  const bool every = n_anchors == n_lines_;
  const double lowest = line_Hz_, highest = df_ * static_cast<double>(n_waves_);
  for (Index a = 0; a < n_anchors; ++a) {
    const double part = static_cast<double>(a) / static_cast<double>(n_anchors - 1);
    anchor_Hz_.push_back(every ? line_Hz_ * static_cast<double>(a + 1) : lowest * std::pow(highest / lowest, part));
  }
  anchor_Hz_.back() = highest;
  for (const double f : anchor_Hz_) factor_.push_back(coherence_factor(field_, f));

  if (!every)
    for (std::size_t a = 1; a < factor_.size(); ++a) pair_.emplace_back(factor_[a - 1], factor_[a]);
  share_.resize(n_lines_);
  for (Index l = 1; l <= n_lines_; ++l) {
    const Bracket at = bracket(line_Hz_ * static_cast<double>(l));
    share_[l - 1] = at.share;
    if (is_double) {
      lower_.push_back(at.lower);
      continue;
    }
    const auto pair = static_cast<std::size_t>(at.lower);
    if (stretch_.empty() || stretch_.back().pair != pair || stretch_.back().count == kLanes) stretch_.push_back({pair, l, 0});
    ++stretch_.back().count;
  }
  for (Index j = 0; j < field_.size(); ++j) {
    if (j == 0 || !field_.same_turbulence(j, j - 1)) {
      amplitude_.conservativeResize(n_lines_, amplitude_.cols() + 1);
      for (Index l = 1; l <= n_lines_; ++l)
        amplitude_(l - 1, amplitude_.cols() - 1) = std::sqrt(2.0 * df_ * field_.spectrum(j, line_Hz_ * static_cast<double>(l)));
    }
    kind_.push_back(amplitude_.cols() - 1);
  }
}

Simulator::Bracket Simulator::bracket(double f_Hz) const {
  const auto above = std::ranges::upper_bound(anchor_Hz_, f_Hz * (1.0 + 1e-12));
  const Index last = std::ssize(anchor_Hz_) - 2;
  const Index lower = std::clamp<Index>(above - anchor_Hz_.begin() - 1, 0, last);
  const double low = anchor_Hz_[static_cast<std::size_t>(lower)], high = anchor_Hz_[static_cast<std::size_t>(lower) + 1];
  return {lower, std::clamp(std::log(f_Hz / low) / std::log(high / low), 0.0, 1.0)};
}

void Simulator::waves(std::uint64_t seed, Index m, Index first, double* real, double* imaginary) const {
  const auto stream = static_cast<std::uint64_t>(field_.component) << 32 | static_cast<std::uint64_t>(m);
  random_waves(seed, stream, first, options_.amplitudes == Amplitudes::gaussian, real, imaginary);
}

/// Half the amplitudes of each point's waves l = 1 … n_waves, at the head of the point's column of `velocity`, which has room
/// for them: no wave reaches half the rate.
void Simulator::put_waves(std::uint64_t seed, MatrixXd& velocity) const {
  const Index n = field_.size();
  // The wind's drift to a point, exp(-2 pi i l turns): that of a stretch's first wave times that of wave 0 … kLanes - 1.
  const double per_metre = field_.frozen ? df_ / field_.speed_m_s.mean() : 0.0;  // turns of wave l = 1 a metre along the wind
  const VectorXd turns = per_metre * field_.position_m.col(0);
  std::vector<Drift> lane_drift(static_cast<std::size_t>(n));
  for (Index j = 0; j < n; ++j) {
    Drift& own = lane_drift[static_cast<std::size_t>(j)];
    drifts(VectorXd::LinSpaced(kLanes, 0.0, (kLanes - 1) * turns[j]).eval().data(), own.real, own.imaginary);
  }
  struct Room {
    std::vector<double> wave;
    Drift first;
  };
  const auto room = [n] { return Room{std::vector<double>(static_cast<std::size_t>(2 * kLanes * n)), {}}; };
  constexpr std::ptrdiff_t kStretches = 8;  // taken by a thread at a time, so that it writes adjacent memory
  const auto put_stretch = [&](Room& own_room, std::size_t k) {
    auto& [wave, first] = own_room;
    const Stretch& at = stretch_[k];
    for (Index m = 0; m < n; ++m) {
      double* own = wave.data() + 2 * kLanes * m;
      waves(seed, m, at.first, own, own + kLanes);
    }
    std::optional<FactorPair> made;  // used with a factor at every frequency, where stored pairs would double the memory
    if (pair_.empty()) made.emplace(factor_[at.pair], factor_[at.pair + 1]);
    const FactorPair& factor = made ? *made : pair_[at.pair];
    WaveLanes lanes{};
    for (Index i = 0; i < at.count; ++i) lanes.share[i] = share_[at.first - 1 + i];
    for (Index j = 0; j < n; ++j) {
      if (j == 0 || kind_[static_cast<std::size_t>(j)] != kind_[static_cast<std::size_t>(j - 1)]) {
        const double* amplitude = &amplitude_(at.first - 1, kind_[static_cast<std::size_t>(j)]);
        for (Index i = 0; i < at.count; ++i) lanes.amplitude[i] = 0.5 * amplitude[i];
      }
      const auto lane = static_cast<std::size_t>(j % kLanes);
      if (lane == 0) {
        double turn[kLanes] = {};
        for (Index i = j; i < std::min<Index>(n, j + kLanes); ++i) turn[i - j] = turns[i] * static_cast<double>(at.first);
        drifts(turn, first.real, first.imaginary);
      }
      double sums[2 * kLanes];
      wave_sums(factor, j, wave.data(), lanes, {first.real[lane], first.imaginary[lane]},
                lane_drift[static_cast<std::size_t>(j)], sums);
      std::copy(sums, sums + 2 * at.count, &velocity(2 * (at.first - 1), j));
    }
  };
  parallel_for_with(stretch_.size(), room, put_stretch, kStretches);
}

void Simulator::put_double_indexed(std::uint64_t seed, Index j, std::complex<double>* lines) const {
  const Index n = field_.size();
  const double turns = field_.frozen ? line_Hz_ * field_.position_m(j, 0) / field_.speed_m_s.mean() : 0.0;  // of k = 1
  std::fill(lines, lines + n_lines_, 0.0);
  double real[kLanes], imaginary[kLanes];
  for (Index first = 1; first <= n_waves_; first += kLanes) {
    for (Index m = 0; m <= j; ++m) {
      waves(seed, m, first, real, imaginary);
      for (Index l = first; l < std::min<Index>(first + kLanes, n_waves_ + 1); ++l) {
        const Index line = (l - 1) * n + m;
        const auto low = static_cast<std::size_t>(lower_[static_cast<std::size_t>(line)]);
        const double share = share_[line];
        double h = (1.0 - share) * factor_[low](j, m) + share * factor_[low + 1](j, m);
        if (!pair_.empty()) h /= std::sqrt(1.0 - (1.0 - share) * share * 2.0 * pair_[low].apart(j));  // rows back to length one
        double cosine = 1.0, sine = 0.0;
        const double turn = turns * static_cast<double>(line + 1);
        unit_wave(std::abs(turn), cosine, sine);
        lines[line] = 0.5 * amplitude_(line, kind_[static_cast<std::size_t>(j)]) * h *
                      std::complex<double>(cosine, turn < 0.0 ? sine : -sine) *
                      std::complex<double>(real[l - first], imaginary[l - first]);
      }
    }
  }
}

MatrixXd Simulator::double_indexed_sample(std::uint64_t seed, Index before) const {
  const Index n = field_.size(), period = n * n_samples_;
  MatrixXd velocity(before + n_samples_, n);
  struct Room {
    signal::RealFft fft;
    VectorXd values;  ///< of a period, the lines before them in the same memory
  };
  parallel_for_with(
      n,
      [&] {
        return Room{signal::RealFft(period), VectorXd(period)};
      },
      [&](Room& own, Index j) {
        double* values = own.values.data();
        auto* lines = reinterpret_cast<std::complex<double>*>(values);
        put_double_indexed(seed, j, lines);
        own.fft.sum_of_waves(lines, 1, n_lines_, values);
        for (Index i = 0; i < velocity.rows(); ++i) velocity(i, j) = values[((i - before) % period + period) % period];
      });
  return velocity;
}

MatrixXd Simulator::sample(std::uint64_t seed, Index before) const {
  if (options_.frequencies == Frequencies::double_indexed) return double_indexed_sample(seed, before);
  MatrixXd velocity(n_samples_, field_.size());
  put_waves(seed, velocity);
  parallel_for_with(
      field_.size(), [this] { return signal::RealFft(n_samples_); },
      [&](signal::RealFft& fft, Index j) {
        double* own = velocity.col(j).data();
        fft.sum_of_waves(reinterpret_cast<const std::complex<double>*>(own), 1, n_waves_, own);
      });
  if (before == 0) return velocity;
  MatrixXd out(before + n_samples_, field_.size());
  for (Index i = 0; i < out.rows(); ++i) out.row(i) = velocity.row(((i - before) % n_samples_ + n_samples_) % n_samples_);
  return out;
}

}  // namespace twindeck::wind
