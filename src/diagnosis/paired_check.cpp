#include "diagnosis/paired_check.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace twindeck::diagnosis {

namespace {

/// Of a frequency, in per cent: identification is taken as no better (scatter.frequency_floor), so that a smaller error of the
/// basis is behind every measured frequency.
constexpr double kBasisErrorPct = 0.1;
/// Of the error of the model's form, beside which a tenth adds nothing that counts (half a per cent of it, in squares).
constexpr double kPartOfForm = 0.1;

/// Positions in the model of the modes that the measured ones of a state are paired with, ascending.
std::vector<int> paired_positions(const FeatureMap& map, const Fit& fit, const std::string& state) {
  std::set<int> out;
  const auto& modes = map.measured_modes();
  for (std::size_t m = 0; m < std::min(modes.size(), fit.all.paired.size()); ++m) {
    const auto& condition = map.features().conditions[static_cast<std::size_t>(modes[m].condition)];
    if (condition.state == state && fit.all.paired[m] >= 0) out.insert(fit.all.paired[m]);
  }
  return {out.begin(), out.end()};
}

/// The check of some of its modes.
FullCheck of_modes(const FullCheck& all, std::vector<int> positions) {
  std::erase_if(positions, [&](int p) { return p >= all.full_Hz.size(); });
  FullCheck out{all.reduced_Hz(positions), all.full_Hz(positions), 0.0, all.message};
  for (Eigen::Index i = 0; i < out.full_Hz.size(); ++i)
    if (out.full_Hz[i] > 0.0)
      out.largest_pct = std::max(out.largest_pct, 100.0 * std::abs(out.reduced_Hz[i] / out.full_Hz[i] - 1.0));
  return out;
}

}  // namespace

double allowed_basis_error_pct(const Diagnosis& result) {
  return std::max(kBasisErrorPct, result.form ? 100.0 * kPartOfForm * result.form->frequency.level : 0.0);
}

FullCheck check_paired_modes(const Structure& structure, const Places& places, const FeatureMap& map, const Diagnosis& result,
                             const std::string& state) {
  Fit fit = result.after;
  std::erase_if(fit.causes, [&](const Cause& cause) { return !cause.candidate->acts_in_state(state); });
  std::vector<int> positions = paired_positions(map, result.after, state);
  if (positions.empty()) positions = {0};
  const FullCheck all = check_against_full(structure, places, map, fit, positions.back() + 1);
  return all.message.empty() ? of_modes(all, positions) : all;
}

}  // namespace twindeck::diagnosis
