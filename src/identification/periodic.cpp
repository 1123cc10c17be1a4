#include "identification/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "core/statistics.hpp"
#include "identification/amplitude.hpp"
#include "signal/condition.hpp"

namespace twindeck::identification {

using Eigen::Index;

std::vector<PeriodicLine> undamped_poles(const std::vector<std::vector<Pole>>& poles, double lowest_Hz, double highest_Hz,
                                         const PeriodicRule& rule) {
  std::vector<const Pole*> undamped;
  for (const std::vector<Pole>& of_order : poles) {
    for (const Pole& pole : of_order) {
      if (std::abs(pole.damping_ratio) < rule.largest_damping && pole.frequency_Hz >= lowest_Hz &&
          pole.frequency_Hz <= highest_Hz)
        undamped.push_back(&pole);
    }
  }
  std::ranges::sort(undamped, [](const Pole* p, const Pole* q) { return p->frequency_Hz < q->frequency_Hz; });
  std::vector<PeriodicLine> lines;
  for (std::size_t first = 0, end = 0; first < undamped.size(); first = end) {
    for (end = first + 1; end < undamped.size(); ++end)
      if (undamped[end]->frequency_Hz > (1.0 + rule.largest_spread) * undamped[end - 1]->frequency_Hz) break;
    std::set<int> orders;
    std::vector<double> frequency, damping;
    const Pole* highest = undamped[first];
    for (std::size_t i = first; i < end; ++i) {
      orders.insert(undamped[i]->order);
      frequency.push_back(undamped[i]->frequency_Hz);
      damping.push_back(undamped[i]->damping_ratio);
      if (undamped[i]->order > highest->order) highest = undamped[i];
    }
    if (static_cast<double>(orders.size()) < rule.share * static_cast<double>(poles.size())) continue;
    lines.push_back({median(frequency), median(damping), highest->shape});
  }
  return lines;
}

namespace {

constexpr double kIndependent = 10.0;  // band width in 1/(length of the record), for about twenty independent values
constexpr double kNarrowest = 0.001;   // [-] of the frequency; the speed of a machine varies by some hundredths of a per cent

double band_of(const PeriodicLine& line, Index n_samples, double rate_Hz) {
  return std::max(kIndependent * rate_Hz / static_cast<double>(n_samples), kNarrowest * line.frequency_Hz);
}

/// E|a|⁴ / (E|a|²)² of the envelope around a frequency, mean over the records.
double envelope_kurtosis(const PeriodicLine& line, const std::vector<Samples>& records, double rate_Hz) {
  constexpr double kSettled = 0.5;  // of 1/band: the filter needs that time at either end
  double sum = 0.0, samples = 0.0;
  for (const Samples& record : records) {
    const auto n = static_cast<double>(record.rows());
    const double band_Hz = band_of(line, record.rows(), rate_Hz);
    const auto end = static_cast<Index>(kSettled * rate_Hz / band_Hz);
    const Eigen::VectorXcd a = modal_coordinate(record, rate_Hz, line.shape, line.frequency_Hz, band_Hz);
    if (a.size() - 2 * end < 8) continue;
    const Eigen::ArrayXd power = a.segment(end, a.size() - 2 * end).cwiseAbs2().array();
    sum += n * power.square().mean() / std::max(std::pow(power.mean(), 2), 1e-300);
    samples += n;
  }
  return samples > 0.0 ? sum / samples : 2.0;
}

/// The number of the multiple of the base; 0 for none.
int multiple_of(double frequency_Hz, double base_Hz, double tolerance) {
  const double ratio = frequency_Hz / base_Hz, whole = std::round(ratio);
  return whole >= 1.0 && std::abs(ratio - whole) < tolerance * whole ? static_cast<int>(whole) : 0;
}

/// Phase of a line [rad], sample by sample, without jumps.
Eigen::ArrayXd phase_of(const PeriodicLine& line, const Samples& record, double rate_Hz) {
  const Eigen::VectorXcd a =
      modal_coordinate(record, rate_Hz, line.shape, line.frequency_Hz, band_of(line, record.rows(), rate_Hz));
  Eigen::ArrayXd phase(a.size());
  phase[0] = std::arg(a[0]);
  for (Index t = 1; t < a.size(); ++t) phase[t] = phase[t - 1] + std::arg(a[t] * std::conj(a[t - 1]));
  return phase;
}

Eigen::ArrayXcd turning(const Eigen::ArrayXd& phase) {
  Eigen::ArrayXcd phasor(phase.size());
  phasor.real() = phase.cos();
  phasor.imag() = phase.sin();
  return phasor;
}

/// Amplitude of the part of each channel that follows a phasor (n_outputs).
Eigen::VectorXcd coherent_part(const Samples& record, const Eigen::ArrayXcd& phasor) {
  return 2.0 / static_cast<double>(record.rows()) *
         (record.transpose().cast<std::complex<double>>() * phasor.conjugate().matrix());
}

/// Power that follows the phasor over the median power at frequencies a few 1/(length of the record) above and below. For noise
/// the ratio exceeds 20 once in 10^6.
double prominence(const Samples& record, const Eigen::ArrayXcd& phasor) {
  constexpr int kNearest = 3, kFarthest = 12;  // in 1/(length of the record)
  std::vector<double> beside;
  const auto n = static_cast<double>(record.rows());
  for (int k = -kFarthest; k <= kFarthest; ++k) {
    if (std::abs(k) < kNearest) continue;
    Eigen::ArrayXcd shifted = phasor;
    const double turn = 2.0 * std::numbers::pi * k / n;
    for (Index t = 0; t < shifted.size(); ++t) shifted[t] *= std::polar(1.0, turn * static_cast<double>(t));
    beside.push_back(coherent_part(record, shifted).squaredNorm());
  }
  return coherent_part(record, phasor).squaredNorm() / std::max(median(beside), 1e-300);
}

/// Subtracts from each channel its least-squares fit of the columns.
void subtract(Samples& record, const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd amplitudes = (columns.transpose() * columns).ldlt().solve(columns.transpose() * record);
  record.noalias() -= columns * amplitudes;
}

Eigen::MatrixXd waves(const Eigen::ArrayXcd& phasor) {
  Eigen::MatrixXd both(phasor.size(), 2);
  both << phasor.real().matrix(), phasor.imag().matrix();
  return both;
}

/// A line of constant frequency and the trend that detrending removed from it: cosine, sine, 1, time.
Eigen::MatrixXd even_columns(double step, Index n) {
  const Eigen::ArrayXd sample = Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  Eigen::MatrixXd columns(n, 4);
  columns << waves(turning(step * sample)), Eigen::VectorXd::Ones(n), Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  return columns;
}

/// Phase step [rad] per sample of a line of constant frequency, by least squares over all channels (Gauss-Newton).
/// @param step  first estimate
double even_step(const Samples& record, double step) {
  constexpr int kTurns = 5;  // each iteration squares the error
  const Index n = record.rows();
  const Eigen::VectorXd time =
      Eigen::VectorXd::LinSpaced(n, -0.5 * static_cast<double>(n - 1), 0.5 * static_cast<double>(n - 1));
  for (int turn = 0; turn < kTurns; ++turn) {
    Eigen::MatrixXd columns(n, 6);
    columns << even_columns(step, n), Eigen::MatrixXd::Zero(n, 2);
    columns.rightCols(2) = time.asDiagonal() * columns.leftCols(2);
    const Eigen::VectorXd unit = columns.colwise().norm().cwiseInverse();
    columns *= unit.asDiagonal();
    const Eigen::MatrixXd fit = unit.asDiagonal() * (columns.transpose() * columns).ldlt().solve(columns.transpose() * record);
    const double ahead = (fit.row(1).cwiseProduct(fit.row(4)) - fit.row(0).cwiseProduct(fit.row(5))).sum();
    step += ahead / fit.topRows(2).squaredNorm();
  }
  return step;
}

/// Takes a line out of a record: with its observed phase, or with a constant frequency if that leaves less. The narrow band
/// distorts the observed phase at the ends of the record, and decimation distorts the line itself. With a constant frequency,
/// the record is therefore cut at both ends.
/// @return the phase [rad]
Eigen::ArrayXd take_out(Samples& record, const PeriodicLine& line, double rate_Hz) {
  constexpr Index end = signal::decimation_reach;
  const Index n = record.rows() - 2 * end;
  Eigen::ArrayXd phase = phase_of(line, record, rate_Hz);
  Samples inner = n > 2 * end ? Samples(record.middleRows(end, n)) : Samples();
  subtract(record, waves(turning(phase)));
  if (inner.rows() == 0) return phase;
  const double seen = (phase[n] - phase[2 * end]) / static_cast<double>(n - 2 * end), step = even_step(inner, seen);
  subtract(inner, even_columns(step, n));
  if (inner.squaredNorm() >= record.middleRows(end, n).squaredNorm()) return phase;
  record = std::move(inner);
  return Eigen::ArrayXd::LinSpaced(n, 0.0, step * static_cast<double>(n - 1));
}

bool is_among(const std::vector<PeriodicLine>& lines, double frequency_Hz, double spread) {
  return std::ranges::any_of(
      lines, [&](const PeriodicLine& line) { return std::abs(line.frequency_Hz - frequency_Hz) < spread * frequency_Hz; });
}

}  // namespace

std::vector<PeriodicLine> without_lines(std::vector<Samples>& records, const std::vector<PeriodicLine>& lines, double rate_Hz,
                                        double lowest_Hz, double highest_Hz, const PeriodicRule& rule) {
  std::vector<PeriodicLine> all = lines;
  for (const PeriodicLine& line : lines) {
    std::vector<Eigen::ArrayXd> phases;
    for (Samples& record : records) phases.push_back(take_out(record, line, rate_Hz));
    const auto look_at = [&](double ratio) {
      PeriodicLine other{ratio * line.frequency_Hz, 0.0, Eigen::VectorXcd(), 1.0};
      // A multiple that is a line itself has its own phase and is subtracted with that.
      if (other.frequency_Hz < lowest_Hz || is_among(all, other.frequency_Hz, rule.largest_spread)) return;
      std::vector<Eigen::ArrayXcd> phasors;
      for (std::size_t r = 0; r < records.size(); ++r) {
        phasors.push_back(turning(ratio * phases[r]));
        if (prominence(records[r], phasors.back()) < rule.least_prominence) return;
      }
      other.shape = coherent_part(records.front(), phasors.front()).normalized();
      for (std::size_t r = 0; r < records.size(); ++r) subtract(records[r], waves(phasors[r]));
      all.push_back(std::move(other));
    };
    for (const double part : {1.0 / 3.0, 1.0 / 2.0}) look_at(part);
    for (int k = 2; k * line.frequency_Hz <= highest_Hz; ++k) look_at(k);
  }
  std::ranges::sort(all, {}, &PeriodicLine::frequency_Hz);
  for (PeriodicLine& line : all)
    for (const PeriodicLine& base : all)
      line.multiple = std::max(line.multiple, multiple_of(line.frequency_Hz, base.frequency_Hz, rule.multiple));
  return all;
}

std::vector<PeriodicLine> periodic_lines(const std::vector<PeriodicLine>& candidates, const std::vector<Samples>& records,
                                         double rate_Hz, const PeriodicRule& rule) {
  std::vector<PeriodicLine> judged = candidates;
  std::vector<double> found_Hz;
  for (PeriodicLine& line : judged) {
    line.kurtosis = envelope_kurtosis(line, records, rate_Hz);
    if (line.kurtosis < rule.largest_kurtosis) found_Hz.push_back(line.frequency_Hz);
  }
  std::vector<PeriodicLine> lines;
  for (PeriodicLine& line : judged) {
    bool of_another = false;
    for (const double base : found_Hz) {
      const int multiple = multiple_of(line.frequency_Hz, base, rule.multiple);
      if (multiple >= 2) line.multiple = std::max(line.multiple, multiple);
      of_another = of_another || multiple >= 2;
    }
    if (line.kurtosis < rule.largest_kurtosis || (of_another && line.kurtosis < rule.largest_kurtosis_of_multiple))
      lines.push_back(line);
  }
  return lines;
}

}  // namespace twindeck::identification
