#include "sysid/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/statistics.hpp"
#include "sysid/amplitude.hpp"

namespace twindeck::sysid {

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
  std::sort(undamped.begin(), undamped.end(), [](const Pole* p, const Pole* q) { return p->frequency_Hz < q->frequency_Hz; });
  std::vector<PeriodicLine> lines;
  for (std::size_t first = 0, end = 0; first < undamped.size(); first = end) {
    for (end = first + 1; end < undamped.size(); ++end) {
      if (undamped[end]->frequency_Hz > (1.0 + rule.largest_spread) * undamped[end - 1]->frequency_Hz) break;
    }
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

/// E|a|⁴ / (E|a|²)² of the envelope around a frequency, mean over the records.
double envelope_kurtosis(const PeriodicLine& line, const std::vector<Eigen::MatrixXd>& records, double rate_Hz) {
  constexpr double kIndependent = 10.0;  // the band is this many times 1/(length of the record): some twenty independent values
  constexpr double kNarrowest = 0.001;   // of the frequency: a machine's speed wanders by some hundredths of a per cent
  constexpr double kSettled = 0.5;       // of 1/band: the filter has settled that far from either end
  double sum = 0.0, samples = 0.0;
  for (const Eigen::MatrixXd& record : records) {
    const auto n = static_cast<double>(record.rows());
    const double band_Hz = std::max(kIndependent * rate_Hz / n, kNarrowest * line.frequency_Hz);
    const auto end = static_cast<Index>(kSettled * rate_Hz / band_Hz);
    const Eigen::VectorXcd a = modal_coordinate(record, rate_Hz, line.shape, line.frequency_Hz, band_Hz);
    if (a.size() - 2 * end < 8) continue;
    const Eigen::ArrayXd power = a.segment(end, a.size() - 2 * end).cwiseAbs2().array();
    sum += n * power.square().mean() / std::max(std::pow(power.mean(), 2), 1e-300);
    samples += n;
  }
  return samples > 0.0 ? sum / samples : 2.0;
}

/// Which multiple of the base it is; 0 for none.
int multiple_of(double frequency_Hz, double base_Hz, double tolerance) {
  const double ratio = frequency_Hz / base_Hz, whole = std::round(ratio);
  return whole >= 1.0 && std::abs(ratio - whole) < tolerance * whole ? static_cast<int>(whole) : 0;
}

}  // namespace

std::vector<PeriodicLine> periodic_lines(const std::vector<PeriodicLine>& candidates,
                                         const std::vector<Eigen::MatrixXd>& records, double rate_Hz,
                                         const PeriodicRule& rule) {
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

}  // namespace twindeck::sysid
