#include "identification/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/statistics.hpp"
#include "signal/condition.hpp"
#include "signal/fft.hpp"
#include "signal/welch.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

/// Settings that differ between ambient records and decays.
struct Kind {
  double prominence;  ///< [-] of a peak over the median around it; chance reaches it less than once in a record
  double rate;        ///< [-] least rate after decimation, over the highest peak
  double periods;     ///< periods of the lowest peak in a block
  bool by_reach;      ///< the highest frequency is the reach of the motion, because modes damped by ten per cent have no peaks
};
constexpr Kind kAmbient{5.0, 3.0, 3.0, false};
constexpr Kind kDecay{30.0, 12.0, 0.5, true};

/// [-] highest over lowest frequency that a model of about a hundred block rows can represent
constexpr double kWidestBand = 16.0;
/// First lines of a spectrum, where a peak cannot be distinguished from drift.
constexpr Index kFirstLine = 8;
constexpr long kShortestSegments = 10;  ///< segments in the shortest record
constexpr long kMostRowsOfAll = 1600;   ///< block rows times channels; a larger matrix takes minutes
constexpr long kMostRows = 200, kFewestRows = 20;
constexpr long kSamplesLeft = 1280;  ///< least samples after decimation: twice twenty block rows in eight blocks

struct Spectrum {
  Eigen::VectorXd frequency_Hz, density;
};

/// Spectrum averaged over segments and channels, each channel divided by its mean square.
Spectrum averaged(const std::vector<Samples>& records, double rate_Hz) {
  const Index shortest = shortest_record(records);
  const signal::WelchOptions options{std::max<Index>(64, shortest / kShortestSegments), 0.5};
  Spectrum spectrum;
  if (options.segment > shortest) return spectrum;
  const Eigen::VectorXd rms = channel_rms(records).cwiseMax(1e-300);
  for (const Samples& record : records) {
    const signal::PowerSpectra one = signal::power_spectra(scaled_channels(record, rms.cwiseInverse()), rate_Hz, options);
    const Eigen::VectorXd density = one.density.rowwise().mean();
    spectrum.density = spectrum.density.size() == 0 ? density : Eigen::VectorXd(spectrum.density + density);
    spectrum.frequency_Hz = one.frequency_Hz;
  }
  return spectrum;
}

/// Spectrum of whole records without a window, because a decay has ended at the end of the record.
Spectrum whole(const std::vector<Samples>& records, double rate_Hz) {
  const Index shortest = shortest_record(records);
  Spectrum spectrum;
  if (shortest < 64) return spectrum;
  const Eigen::VectorXd rms = channel_rms(records).cwiseMax(1e-300);
  signal::RealFft fft(shortest);
  spectrum.density = Eigen::VectorXd::Zero(shortest / 2 + 1);
  for (const Samples& record : records) {
    for (Index c = 0; c < record.cols(); ++c) {
      const Eigen::VectorXd channel = record.col(c).tail(shortest);
      spectrum.density += fft.forward(Eigen::VectorXd(channel.array() - channel.mean())).cwiseAbs2() / (rms[c] * rms[c]);
    }
  }
  spectrum.frequency_Hz = Eigen::VectorXd::LinSpaced(spectrum.density.size(), 0.0, 0.5 * rate_Hz);
  return spectrum;
}

/// Frequency above which a thousandth of the motion lies, without the noise of the sensors. It gives the band of motions whose
/// peaks are too broad to stand out.
double reach_of(const Spectrum& spectrum) {
  constexpr double kShare = 1e-3, kChance = 4.0;  // [-] of the motion; standard deviations of the noise
  const Index n = spectrum.density.size();
  const double* density = spectrum.density.data();
  const double floor = upper_median({density + n / 2, density + n}) / std::log(2.0);  // mean from the median
  const double all = spectrum.density.sum() - floor * static_cast<double>(n);
  double above = 0.0;
  for (Index i = n - 1; i > 0; --i) {
    above += spectrum.density[i] - floor;
    if (above > kShare * all + kChance * floor * std::sqrt(static_cast<double>(n - i))) return spectrum.frequency_Hz[i];
  }
  return spectrum.frequency_Hz[n - 1];
}

Sampling choose(const Spectrum& spectrum, const Kind& kind, const std::vector<Samples>& records, double rate_Hz,
                const IdentificationSettings& config) {
  Sampling chosen;
  const double nyquist = 0.5 * rate_Hz / static_cast<double>(std::max(config.decimation, 1L));
  const bool as_recorded = config.decimation <= 1 && !kind.by_reach;
  const double highest =
      config.highest_Hz > 0.0 ? config.highest_Hz : (as_recorded ? kUnfilteredBand : kFilteredBand) * nyquist;
  const std::vector<double> peaks =
      spectral_peaks(spectrum.frequency_Hz, spectrum.density, kind.prominence, config.lowest_Hz, highest);
  if (config.decimation > 0) chosen.decimation = config.decimation;
  if (config.block_rows > 0) chosen.block_rows = config.block_rows;
  if (peaks.empty()) {
    chosen.note = "no peak stands out of the spectrum: the record is taken as it is; set decimation and block_rows";
    return chosen;
  }
  chosen.lowest_Hz = peaks.front();
  const double top = kind.by_reach ? nyquist : kWidestBand * chosen.lowest_Hz;
  for (const double peak : peaks)
    if (peak <= top) chosen.highest_Hz = peak;
  if (kind.by_reach) chosen.highest_Hz = std::max(chosen.highest_Hz, std::min(reach_of(spectrum), highest));
  const double kept_Hz = config.highest_Hz > 0.0 ? config.highest_Hz : chosen.highest_Hz;
  const Index shortest = shortest_record(records);
  if (config.decimation == 0) {
    const auto most = static_cast<long>(rate_Hz / (kind.rate * kept_Hz));
    chosen.decimation = std::clamp(most, 1L, std::max(1L, static_cast<long>(shortest) / kSamplesLeft));
  }
  const double rate = rate_Hz / static_cast<double>(chosen.decimation);
  std::string fewer;
  if (config.block_rows == 0) {
    const long most = std::clamp(kMostRowsOfAll / static_cast<long>(records.front().cols()), kFewestRows, kMostRows);
    const long wanted = block_rows_of(kind.periods, rate, chosen.lowest_Hz);
    chosen.block_rows = std::clamp(wanted, kFewestRows, most);
    if (wanted > most)
      fewer = fmt::format("; {:g} periods of the lowest peak need {} block rows, more than {} channels carry in short time",
                          kind.periods, wanted, records.front().cols());
  }
  const double left_out = peaks.back();
  chosen.note = fmt::format(
      "{:.4g} Hz (decimation {}) and {} block rows ({:.3g} s) are chosen for motion from {:.4g} to {:.4g} Hz{}{}", rate,
      chosen.decimation, chosen.block_rows, static_cast<double>(chosen.block_rows) / rate, chosen.lowest_Hz, chosen.highest_Hz,
      fewer, left_out > top ? fmt::format("; peaks up to {:.4g} Hz need a run of their own: band.lowest", left_out) : "");
  return chosen;
}

}  // namespace

long block_rows_of(double periods, double rate_Hz, double frequency_Hz) {
  return static_cast<long>(std::ceil(periods * rate_Hz / frequency_Hz));
}

std::vector<double> spectral_peaks(const Eigen::VectorXd& frequency_Hz, const Eigen::VectorXd& density, double prominence,
                                   double lowest_Hz, double highest_Hz) {
  std::vector<double> peaks;
  const Eigen::VectorXd& s = density;
  for (Index i = kFirstLine; i + 1 < s.size(); ++i) {
    const double f = frequency_Hz[i];
    if (f < lowest_Hz || (highest_Hz > 0.0 && f > highest_Hz) || s[i] < s[i - 1] || s[i] < s[i + 1]) continue;
    const Index reach = std::max<Index>(kFirstLine / 2, i / 4), from = std::max<Index>(1, i - reach);
    const Index to = std::min(s.size(), i + reach + 1);
    if (s[i] > prominence * upper_median({s.data() + from, s.data() + to})) peaks.push_back(f);
  }
  return peaks;
}

Sampling choose_sampling(const std::vector<Samples>& records, double rate_Hz, const IdentificationSettings& config) {
  return choose(averaged(records, rate_Hz), kAmbient, records, rate_Hz, config);
}

Sampling choose_decay_sampling(const std::vector<Samples>& records, double rate_Hz, const IdentificationSettings& config) {
  return choose(whole(records, rate_Hz), kDecay, records, rate_Hz, config);
}

void settle_sampling(Conditioned& conditioned, const IdentificationSettings& config, bool is_decay) {
  conditioned.block_rows = config.block_rows;
  conditioned.filtered = config.decimation > 1;
  if (config.decimation > 0 && config.block_rows > 0) return;
  const Sampling chosen = is_decay ? choose_decay_sampling(conditioned.records, conditioned.rate_Hz, config)
                                   : choose_sampling(conditioned.records, conditioned.rate_Hz, config);
  conditioned.block_rows = chosen.block_rows;
  if (is_decay) conditioned.reach_Hz = chosen.highest_Hz;
  const bool limited = conditioned.reach_Hz > 0.0 && config.highest_Hz == 0.0;
  conditioned.notes.push_back(fmt::format("setup {}: {}{}", conditioned.setup, chosen.note,
                                          limited ? "; modes are looked for there (band.highest sets another limit)" : ""));
  if (config.decimation > 0 || chosen.decimation == 1) return;
  for (std::vector<Samples>* all : {&conditioned.records, &conditioned.excitation})
    for (Samples& record : *all) record = signal::detrended(signal::decimated(record, chosen.decimation));
  conditioned.rate_Hz /= static_cast<double>(chosen.decimation);
  conditioned.filtered = true;
}

}  // namespace twindeck::identification
