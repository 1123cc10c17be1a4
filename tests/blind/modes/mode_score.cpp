#include "blind/modes/mode_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blind/exact_intervals.hpp"
#include "identification/identification.hpp"
#include "signal/condition.hpp"

namespace twindeck::blind::modes {

using Eigen::Index;

namespace {

constexpr double kSettledDeviation = 0.005;  ///< [-] of the frequency: what "settled" means
constexpr double kSameShape = 0.8;           ///< [-] MAC from which two shapes are one
constexpr double kAnswers = 0.5;             ///< [-] MAC from which an identified mode may answer to a true one
constexpr double kFarthest = 0.025;          ///< [-] of the frequency: no mode answers to a true one from further away
constexpr double kLineWidth = 0.001;         ///< [-] of the frequency: a mark this near to a line is the line's

Eigen::VectorXd at(const Eigen::VectorXd& shape, const std::vector<Index>& channels) {
  Eigen::VectorXd part(static_cast<Index>(channels.size()));
  for (Index c = 0; c < part.size(); ++c) part[c] = shape[channels[static_cast<std::size_t>(c)]];
  return part;
}

/// Standard deviation that the oracle gets in one setup; infinite where it sees no pole of the mode.
double oracle_deviation(const TrueMode& mode, const Eigen::VectorXd& shape, const identification::Identification& setup) {
  double deviation = 1e300;
  for (const identification::DiagramPole& p : setup.diagram) {
    if (std::abs(p.pole.frequency_Hz - mode.frequency_Hz) > 3.0 * kSettledDeviation * mode.frequency_Hz) continue;
    if (p.frequency_std_Hz < deviation && known_mac(shape, p.pole.shape) >= kSameShape) deviation = p.frequency_std_Hz;
  }
  return deviation;
}

void find_settled(const RandomRecords& truth, const IdentifiedRecords& found, ModeScore& score) {
  for (std::size_t r = 0; r < truth.modes.size(); ++r) {
    const TrueMode& mode = truth.modes[r];
    ModeOutcome& outcome = score.modes[r];
    outcome.oracle_std_Hz = 1e300;
    for (std::size_t s = 0; s < found.setups.size(); ++s) {
      const auto& channels = truth.setups[s].channels;
      const Eigen::VectorXd shape = at(mode.shape, channels).cwiseQuotient(found.scale[s]);
      const double deviation = oracle_deviation(mode, shape, found.setups[s]);
      if (deviation > kSettledDeviation * mode.frequency_Hz || deviation >= outcome.oracle_std_Hz) continue;
      bool apart = true;
      for (std::size_t k = 0; k < truth.modes.size(); ++k) {
        if (k == r || std::abs(truth.modes[k].frequency_Hz - mode.frequency_Hz) > 3.0 * deviation) continue;
        const Eigen::VectorXcd other =
            at(truth.modes[k].shape, channels).cwiseQuotient(found.scale[s]).cast<std::complex<double>>();
        apart = apart && known_mac(shape, other) < kSameShape;
      }
      if (!apart) continue;
      outcome.settled = true;
      outcome.oracle_std_Hz = deviation;
    }
  }
}

void pair_modes(const RandomRecords& truth, const IdentifiedRecords& found, ModeScore& score) {
  struct Pair {
    double distance;
    std::size_t mode;
    int found;
    double mac;
  };
  std::vector<Pair> pairs;
  for (std::size_t r = 0; r < truth.modes.size(); ++r) {
    const double f = truth.modes[r].frequency_Hz;
    for (std::size_t m = 0; m < found.modes.size(); ++m) {
      const double off = std::abs(found.modes[m].frequency_Hz - f);
      const double most = std::clamp(4.0 * found.modes[m].deviation.frequency_Hz, kSettledDeviation * f, kFarthest * f);
      const double mac = known_mac(truth.modes[r].shape, found.modes[m].shape);
      if (off <= most && mac >= kAnswers) pairs.push_back({off / f + 1.0 - mac, r, static_cast<int>(m), mac});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.distance < q.distance; });
  std::vector<bool> taken(found.modes.size(), false);
  for (const Pair& pair : pairs) {
    ModeOutcome& outcome = score.modes[pair.mode];
    if (outcome.found >= 0 || taken[static_cast<std::size_t>(pair.found)]) continue;
    outcome.found = pair.found;
    outcome.mac = pair.mac;
    taken[static_cast<std::size_t>(pair.found)] = true;
  }
  for (std::size_t m = 0; m < taken.size(); ++m) {
    if (!taken[m]) score.spurious.push_back(static_cast<int>(m));
  }
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

double known_mac(const Eigen::VectorXd& truth, const Eigen::VectorXcd& shape) {
  std::complex<double> product = 0.0;
  double aa = 0.0, bb = 0.0;
  for (Index i = 0; i < truth.size(); ++i) {
    if (std::isnan(shape[i].real())) continue;
    product += truth[i] * shape[i];
    aa += truth[i] * truth[i];
    bb += std::norm(shape[i]);
  }
  return aa > 0.0 && bb > 0.0 ? std::norm(product) / (aa * bb) : 0.0;
}

IdentifiedRecords identify_records(const RandomRecords& records) {
  identification::IdentificationSettings config;
  config.block_rows = 40;
  config.maximum_order = 80;
  IdentifiedRecords result;
  std::vector<identification::SetupModes> setups;
  for (std::size_t s = 0; s < records.setups.size(); ++s) {
    identification::Conditioned conditioned;
    conditioned.setup = "S" + std::to_string(s + 1);
    conditioned.rate_Hz = records.rate_Hz;
    conditioned.channels.resize(records.setups[s].channels.size());
    for (std::size_t c = 0; c < conditioned.channels.size(); ++c) conditioned.references.push_back(static_cast<Index>(c));
    conditioned.records.push_back(signal::detrended(records.setups[s].record));
    result.scale.push_back(identification::channel_rms(conditioned.records));
    result.setups.push_back(identification::identify_modes(conditioned, config));
  }
  std::vector<identification::Identification*> all;
  for (identification::Identification& setup : result.setups) all.push_back(&setup);
  identification::drop_lines_of_others(all, config.periodic);
  for (std::size_t s = 0; s < result.setups.size(); ++s)
    setups.push_back(
        {"S" + std::to_string(s + 1), records.setups[s].channels, result.setups[s].modes, result.setups[s].deviations});
  result.modes = identification::merge_poser(setups, records.n_channels, records.references, {});
  return result;
}

ModeScore score(const RandomRecords& truth, const IdentifiedRecords& found) {
  ModeScore result;
  result.modes.resize(truth.modes.size());
  find_settled(truth, found, result);
  pair_modes(truth, found, result);
  for (std::size_t r = 0; r < truth.modes.size(); ++r) {
    const ModeOutcome& outcome = result.modes[r];
    if (!outcome.settled) continue;
    ++result.settled;
    if (outcome.found < 0) continue;
    ++result.recalled;
    if (outcome.mac >= kSameShape) ++result.alike;
    const identification::MergedMode& mode = found.modes[static_cast<std::size_t>(outcome.found)];
    result.frequency_error.push_back((mode.frequency_Hz - truth.modes[r].frequency_Hz) / mode.deviation.frequency_Hz);
    result.damping_error.push_back((mode.damping_ratio - truth.modes[r].damping_ratio) / mode.deviation.damping_ratio);
  }
  for (const double line_Hz : truth.machine_Hz) {
    const bool marked = std::any_of(found.setups.begin(), found.setups.end(), [&](const identification::Identification& setup) {
      return std::any_of(setup.periodic.begin(), setup.periodic.end(), [&](const identification::PeriodicLine& line) {
        return std::abs(line.frequency_Hz - line_Hz) < kLineWidth * line_Hz;
      });
    });
    result.flagged += marked ? 1 : 0;
  }
  return result;
}

void ModeTotals::add(const RandomRecords& truth, const ModeScore& one) {
  ++records;
  settled += one.settled;
  recalled += one.recalled;
  alike += one.alike;
  spurious += static_cast<int>(one.spurious.size());
  lines += static_cast<int>(truth.machine_Hz.size());
  flagged += one.flagged;
  frequency_error.insert(frequency_error.end(), one.frequency_error.begin(), one.frequency_error.end());
  damping_error.insert(damping_error.end(), one.damping_error.begin(), one.damping_error.end());
}

bool print_totals(const ModeTotals& totals) {
  bool held = true;
  // Held: the point estimate reaches the target. Missed within chance: it does not, but the interval does.
  const auto verdict = [&](bool reaches, bool wrong) {
    held = held && !wrong;
    return wrong ? "MISSED" : reaches ? "held" : "missed within chance";
  };
  const auto share = [&](const char* what, int k, int n, double target) {
    const auto [low, high] = exact_interval(k, n);
    fmt::print("  {:<50} {:>5}/{:<5} {:>6.2f} %  [{:>6.2f}, {:>6.2f}]  target >= {:.0f} %  {}\n", what, k, n,
               n > 0 ? 100.0 * k / n : 0.0, 100.0 * low, 100.0 * high, 100.0 * target,
               n == 0 ? "no case" : verdict(k >= target * n, high < target));
  };
  share("modes that the records settle: found", totals.recalled, totals.settled, 0.98);
  fmt::print("  {:<50} {:>5}/{:<5} {:>6.2f} %\n", "of these with a MAC of 0.8 and more", totals.alike, totals.recalled,
             totals.recalled > 0 ? 100.0 * totals.alike / totals.recalled : 0.0);
  constexpr double kSpurious = 0.05;
  const auto [low, high] = exact_count_interval(totals.spurious);
  const double n = std::max(1, totals.records);
  fmt::print("  {:<50} {:>5}/{:<5} {:>6.3f}    [{:>6.3f}, {:>6.3f}]  target <= {:.2f}  {}\n", "spurious modes a record",
             totals.spurious, totals.records, totals.spurious / n, low / n, high / n, kSpurious,
             verdict(totals.spurious <= kSpurious * n, low / n > kSpurious));
  share("lines of machines marked", totals.flagged, totals.lines, 0.95);
  const auto deviation = [&](const char* what, const std::vector<double>& errors) {
    const double rms = root_mean_square(errors);
    const auto [from, to] = exact_deviation_interval(rms, static_cast<int>(errors.size()));
    fmt::print("  {:<50} {:>11} {:>6.2f}    [{:>6.2f}, {:>6.2f}]  target 0.8 to 1.25  {}\n", what, errors.size(), rms, from, to,
               verdict(rms >= 0.8 && rms <= 1.25, to < 0.8 || from > 1.25));
  };
  deviation("errors of frequencies over their deviations", totals.frequency_error);
  deviation("errors of damping ratios over their deviations", totals.damping_error);
  return held;
}

}  // namespace twindeck::blind::modes
