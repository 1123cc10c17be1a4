#include "steps/diagnosis/full_model_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace twindeck::steps {

namespace {

using diagnosis::FullCheck;

/// Of a frequency, in per cent: identification is taken as no better (scatter.frequency_floor), so that a smaller error of the
/// basis is behind every measured frequency.
constexpr double kBasisErrorPct = 0.1;
/// Of the error of the model's form, beside which a tenth adds nothing that counts (half a per cent of it, in squares).
constexpr double kPartOfForm = 0.1;

/// Error of the basis up to which it is behind what is not known anyway, in per cent.
double largest_allowed_pct(const diagnosis::Diagnosis& result) {
  return std::max(kBasisErrorPct, result.form ? 100.0 * kPartOfForm * result.form->frequency.level : 0.0);
}

/// Positions in the model of the modes that the measured ones of a state are paired with, ascending.
std::vector<int> paired_positions(const diagnosis::FeatureMap& map, const diagnosis::Fit& fit, const std::string& state) {
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

FullCheck checked_against_full(const DiagnosisInputs& inputs, const diagnosis::FeatureMap& map,
                               const diagnosis::Diagnosis& result, runner::StepContext& context) {
  const std::string state = last_state(inputs.features);
  diagnosis::Fit fit = result.after;
  std::erase_if(fit.causes, [&](const diagnosis::Cause& cause) { return !cause.candidate->acts_in_state(state); });
  std::vector<int> positions = paired_positions(map, result.after, state);
  if (positions.empty()) positions = {0};
  const FullCheck all = check_against_full(inputs.model->structure(), inputs.places, map, fit, positions.back() + 1);
  if (!all.message.empty()) {
    context.warn("the extended model was not checked against the full one, which cannot be solved: " + all.message);
    return all;
  }
  const FullCheck check = of_modes(all, positions);
  context.say(fmt::format("reduced basis against the full model: the {} paired frequencies agree to {:.4f} %",
                          check.full_Hz.size(), check.largest_pct));
  const double allowed_pct = largest_allowed_pct(result);
  if (check.largest_pct > allowed_pct)
    context.warn(
        fmt::format("the reduced basis is too small for the measured modes: their frequencies are up to {:.2g} % off the "
                    "full model's (more than {:.2g} %); set modes above {}",
                    check.largest_pct, allowed_pct, inputs.basis_modes));
  return check;
}

}  // namespace twindeck::steps
