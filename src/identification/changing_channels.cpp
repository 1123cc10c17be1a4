#include "identification/changing_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "identification/channel_lag.hpp"

namespace twindeck::identification {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;

constexpr Index kQuarters = 4, kPerQuarter = 5;     // parts of a record, segments in each
constexpr Index kLongestSegment = Index{1} << 16U;  // [samples] of a segment, whose kernel then takes 100 MB for ten modes
constexpr Index kMostLines = 9;                     // of a mode in a segment, about its peak
constexpr double kGainDeviations = 10.0;            // as for a lag of the whole record
constexpr double kLeastChange = 0.1;  // [-] of the gain; a smaller one leaves a shape of two channels a MAC of 0.997
constexpr double kTurned = 0.9;       // cosine of half a turn, less what noise leaves
constexpr double kLeastSize = 3.0;    // deviations of a component that has a ratio

/// Part of each channel in each mode (n_channels × n_modes), and its relative variance.
struct Parts {
  MatrixXcd size;
  MatrixXd variance;
};

/// Spectral lines of a mode [rad/sample] in a segment of n samples: those within its half-power band, three at least.
std::vector<double> lines_of(const Cluster& mode, double rate_Hz, Index n) {
  const double spacing = 2.0 * pi / static_cast<double>(n), centre = 2.0 * pi * mode.frequency_Hz / rate_Hz;
  const auto half = std::clamp(static_cast<Index>(mode.damping_ratio * centre / spacing), Index{1}, (kMostLines - 1) / 2);
  std::vector<double> out;
  for (Index k = -half; k <= half; ++k) out.push_back(centre + static_cast<double>(k) * spacing);
  return out;
}

/// Spectral lines of the modes in a quarter of a record.
struct Lines {
  std::vector<Index> first;        ///< position of each mode's lines, and their number at the end
  std::vector<MatrixXcd> spectra;  ///< (n_lines × n_channels) of each segment
};

Lines lines_in(const Eigen::Ref<const MatrixXd>& quarter, double rate_Hz, const std::vector<Cluster>& modes) {
  const Index apart = quarter.rows() / kPerQuarter, n = std::min(apart, kLongestSegment);
  Lines out{{0}, {}};
  std::vector<double> lines;
  for (const Cluster& mode : modes) {
    for (const double line : lines_of(mode, rate_Hz, n)) lines.push_back(line);
    out.first.push_back(std::ssize(lines));
  }
  MatrixXcd kernel(std::ssize(lines), n);  // Hann window times exp(-i omega t)
  for (Index t = 0; t < n; ++t) {
    const double window = 0.5 - 0.5 * std::cos(2.0 * pi * (static_cast<double>(t) + 0.5) / static_cast<double>(n));
    for (Index k = 0; k < kernel.rows(); ++k)
      kernel(k, t) = std::polar(window, -lines[static_cast<std::size_t>(k)] * static_cast<double>(t));
  }
  for (Index s = 0; s < kPerQuarter; ++s) out.spectra.push_back(kernel * quarter.middleRows(s * apart, n));
  return out;
}

/// @param sound  (n_channels) 1 for channels that tell the motion of a mode, else 0
Parts parts_of(const Lines& lines, const std::vector<Cluster>& modes, const Eigen::VectorXd& sound) {
  Parts out{MatrixXcd::Zero(sound.size(), std::ssize(modes)), MatrixXd::Zero(sound.size(), std::ssize(modes))};
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const Index count = lines.first[m + 1] - lines.first[m], at = static_cast<Index>(m);
    MatrixXcd x(kPerQuarter * count, sound.size());
    for (Index s = 0; s < kPerQuarter; ++s)
      x.middleRows(s * count, count) = lines.spectra[static_cast<std::size_t>(s)].middleRows(lines.first[m], count);
    const Eigen::VectorXcd y = x * modes[m].shape.conjugate().cwiseProduct(sound);
    const double power = y.squaredNorm();
    out.size.col(at) = (y.adjoint() * x).transpose() / power;
    for (Index c = 0; c < sound.size(); ++c)
      out.variance(c, at) = (x.col(c) - y * out.size(c, at)).squaredNorm() / static_cast<double>(x.rows() - 1) / power /
                            std::norm(out.size(c, at));
  }
  return out;
}

/// How a channel differs between two quarters.
struct Difference {
  double log_gain = 0.0, deviation = 0.0;  ///< weighted mean over the modes; deviation that their scatter gives
  bool reversed = false;
  Lag lag;
  double size = 0.0;  ///< mean square of the relative change
};

std::optional<Difference> difference(const Parts& before, const Parts& after, const std::vector<Cluster>& modes, Index c) {
  std::vector<Phase> phases;
  std::vector<double> log_ratio;
  double change = 0.0;
  for (Index m = 0; m < before.size.cols(); ++m) {
    const double variance = before.variance(c, m) + after.variance(c, m);
    if (!(before.variance(c, m) * kLeastSize * kLeastSize < 1.0 && after.variance(c, m) * kLeastSize * kLeastSize < 1.0))
      continue;
    const std::complex<double> ratio = after.size(c, m) / before.size(c, m);
    phases.push_back({2.0 * pi * modes[static_cast<std::size_t>(m)].frequency_Hz, std::arg(ratio), 2.0 / variance});
    log_ratio.push_back(std::log(std::abs(ratio)));
    change += 2.0 / variance * std::norm(ratio - 1.0);
  }
  const auto lag = fitted_lag(phases);
  if (!lag) return {};
  Difference out;
  out.lag = *lag;
  double weights = 0.0, sum = 0.0, cosines = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    weights += phases[k].weight;
    sum += phases[k].weight * log_ratio[k];
    cosines += phases[k].weight * std::cos(phases[k].angle_rad + phases[k].omega_rad_s * lag->seconds);
  }
  out.log_gain = sum / weights;
  for (std::size_t k = 0; k < phases.size(); ++k) squares += phases[k].weight * std::pow(log_ratio[k] - out.log_gain, 2);
  out.deviation = std::sqrt(std::max(1.0, squares / static_cast<double>(phases.size() - 1)) / weights);
  out.reversed = cosines < -kTurned * weights;
  out.size = change / weights;
  return out;
}

/// What changes, in words; empty if nothing does.
std::string in_words(const Difference& d, double highest_Hz, double seconds) {
  if (d.reversed) return "is reversed";
  if (std::abs(d.log_gain) > std::max(kGainDeviations * d.deviation, kLeastChange))
    return fmt::format("has {:.3g} times its gain", std::exp(d.log_gain));
  if (d.lag.matters(highest_Hz))
    return fmt::format("is {:.3g} ms {} (a clock {:.2g} % {}, if it goes on)", 1e3 * std::abs(d.lag.seconds),
                       d.lag.seconds > 0.0 ? "late" : "early", 100.0 * std::abs(d.lag.seconds) / seconds,
                       d.lag.seconds > 0.0 ? "slow" : "fast");
  return "";
}

/// The channel of a record that changes most, where and how.
struct Changed {
  Index channel = -1, quarter = 0;
  double size = 0.0;
};

Changed most_changed(const std::vector<Lines>& quarters, const std::vector<Cluster>& modes, const Eigen::VectorXd& sound,
                     double highest_Hz) {
  const Parts before = parts_of(quarters.front(), modes, sound);
  Changed out;
  for (Index q = 1; q < kQuarters; ++q) {
    const Parts after = parts_of(quarters[static_cast<std::size_t>(q)], modes, sound);
    for (Index c = 0; c < sound.size(); ++c) {
      const auto d = sound[c] > 0.0 && c != out.channel ? difference(before, after, modes, c) : std::nullopt;
      if (!d || d->size <= out.size) continue;
      if (!in_words(*d, highest_Hz, 1.0).empty()) out = {c, q, d->size};
    }
  }
  return out;
}

}  // namespace

std::vector<std::string> changes_within_records(const Conditioned& conditioned, const Identification& found) {
  std::vector<std::string> out;
  double highest_Hz = 0.0;
  for (const Cluster& mode : found.modes) highest_Hz = std::max(highest_Hz, mode.frequency_Hz);
  for (std::size_t r = 0; r < conditioned.records.size(); ++r) {
    const Samples& record = conditioned.records[r];
    const Index n = record.rows() / kQuarters;
    const double seconds = static_cast<double>(n) / conditioned.rate_Hz;
    std::vector<Lines> quarters;
    for (Index q = 0; q < kQuarters; ++q)
      quarters.push_back(lines_in(record.middleRows(q * n, n), conditioned.rate_Hz, found.modes));
    Eigen::VectorXd sound = Eigen::VectorXd::Ones(record.cols());
    for (Changed changed; (changed = most_changed(quarters, found.modes, sound, highest_Hz)).channel >= 0;) {
      sound[changed.channel] = 0.0;  // the others alone tell how far it is off
      const double from_s = static_cast<double>(changed.quarter) * seconds;
      const auto d = difference(parts_of(quarters.front(), found.modes, sound),
                                parts_of(quarters[static_cast<std::size_t>(changed.quarter)], found.modes, sound), found.modes,
                                changed.channel);
      const std::string what = d ? in_words(*d, highest_Hz, from_s) : "";
      const std::string& name = conditioned.channels[static_cast<std::size_t>(changed.channel)].name;
      out.push_back(fmt::format(
          "setup {}: {}: from {:.4g} s on {} {}, judged by the other channels against the record's first quarter: its shapes "
          "are wrong; cut the record before the change, or leave the channel out (--set 'exclude=[\"{}\"]')",
          conditioned.setup, conditioned.files[r], from_s, name, what.empty() ? "changes" : what, name));
    }
  }
  return out;
}

}  // namespace twindeck::identification
