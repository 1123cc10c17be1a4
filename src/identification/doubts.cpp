#include "identification/doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/lists.hpp"
#include "core/statistics.hpp"
#include "identification/sampling.hpp"

namespace twindeck::identification {

namespace {

constexpr double kShortBlock = 0.9;  ///< [-] of the least periods, below which a block is named; a peak is known to a line only
/// [-] factor between a damping ratio and the median of all modes above which a mode is named, and standard deviations by which
/// it must be exceeded
constexpr double kFarDamping = 4.0, kSure = 3.0;
constexpr std::size_t kFewestModes = 4;  ///< [-] the median of fewer damping ratios means little
constexpr double kNearPeak = 0.03;       ///< [-] of the frequency, between a peak and a mode
constexpr std::size_t kMostPeaks = 3;    ///< named

void short_blocks(const ConditionResult& result, std::vector<std::string>& doubts) {
  for (const SetupResult& setup : result.setups) {
    if (setup.found.modes.empty()) continue;
    const double lowest = setup.found.modes.front().frequency_Hz, rate = setup.conditioned.rate_Hz;
    const long needed = block_rows_of(kLeastPeriods, rate, lowest);
    if (static_cast<double>(setup.limits.block_rows) >= kShortBlock * static_cast<double>(needed)) continue;
    doubts.push_back(fmt::format(
        "setup {}: {} block rows ({:.3g} s) are shorter than two periods of the mode at {:.4g} Hz, whose damping may "
        "be off; raise block_rows to {} or decimate more",
        setup.conditioned.setup, setup.limits.block_rows, static_cast<double>(setup.limits.block_rows) / rate, lowest, needed));
  }
}

void far_dampings(const ConditionResult& result, std::vector<std::string>& doubts) {
  if (result.modes.size() < kFewestModes) return;
  const double median = upper_median(each_of(result.modes, &MergedMode::damping_ratio));
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    const double zeta = result.modes[m].damping_ratio, sure = kSure * result.modes[m].deviation.damping_ratio;
    if (zeta - sure < kFarDamping * median && zeta + sure > median / kFarDamping) continue;
    doubts.push_back(
        fmt::format("mode {} at {:.4g} Hz has a damping ratio of {:.3g} %, far from the {:.3g} % of the other modes", m + 1,
                    result.modes[m].frequency_Hz, 100.0 * zeta, 100.0 * median));
  }
}

bool is_explained(const SetupResult& setup, double f) {
  const auto near = [&](double other, double half_width) { return std::abs(other - f) <= std::max(kNearPeak * f, half_width); };
  const double spacing = setup.singular.frequency_Hz[1] - setup.singular.frequency_Hz[0];
  const auto mode = std::ranges::any_of(setup.found.modes, [&](const Cluster& m) {
    return near(m.frequency_Hz, std::max(3.0 * spacing, 2.0 * m.damping_ratio * m.frequency_Hz));
  });
  const auto line =
      std::ranges::any_of(setup.found.periodic, [&](const PeriodicLine& p) { return near(p.frequency_Hz, 3.0 * spacing); });
  return mode || line;
}

void peaks_without_mode(const ConditionResult& result, std::vector<std::string>& doubts) {
  for (const SetupResult& setup : result.setups) {
    if (setup.singular.frequency_Hz.size() < 2) continue;
    const double highest = setup.limits.highest_Hz > 0.0 ? setup.limits.highest_Hz : 0.4 * setup.conditioned.rate_Hz;
    std::vector<std::string> left;
    for (const double f : spectral_peaks(setup.singular.frequency_Hz, setup.singular.values.col(0), kClearPeak,
                                         setup.limits.lowest_Hz, highest)) {
      if (!is_explained(setup, f)) left.push_back(fmt::format("{:.4g}", f));
    }
    if (left.empty()) continue;
    const std::size_t n = left.size();
    left.resize(std::min(n, kMostPeaks));
    doubts.push_back(fmt::format("setup {}: the spectrum has {} without a mode, at {} Hz{}; see poles.csv",
                                 setup.conditioned.setup, n == 1 ? "a peak" : fmt::format("{} peaks", n), fmt::join(left, ", "),
                                 n > kMostPeaks ? " …" : ""));
  }
}

}  // namespace

std::vector<std::string> doubts_of(const ConditionResult& result) {
  std::vector<std::string> doubts;
  short_blocks(result, doubts);
  far_dampings(result, doubts);
  peaks_without_mode(result, doubts);
  return doubts;
}

}  // namespace twindeck::identification
