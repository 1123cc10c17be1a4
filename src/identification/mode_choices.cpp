#include "identification/mode_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"

namespace twindeck::identification {

namespace {

/// [-] Tolerance of the frequency and of the damping ratio: the digits that the page shows.
constexpr double kSamePoleFrequency = 1e-3, kSamePoleDamping = 1e-3;
/// Tolerances for poles of other orders that are the same mode, as for a stable pole in paper section 3.1.
constexpr double kSameModeFrequency = 0.02, kSameModeMac = 0.95;
constexpr double kLeastShapeDeviation = 0.02;  ///< [-] of a unit-norm shape of a picked mode

/// The pole of the chosen order nearest to the chosen frequency.
std::optional<std::size_t> pole_of_choice(const ModeChoice& choice, const std::vector<DiagramPole>& diagram) {
  std::optional<std::size_t> best;
  double least = kSamePoleFrequency;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    const Pole& pole = diagram[i].pole;
    const double off = std::abs(pole.frequency_Hz / choice.frequency_Hz - 1.0);
    if (pole.order != choice.order || off > least || std::abs(pole.damping_ratio - choice.damping_ratio) > kSamePoleDamping)
      continue;
    least = off;
    best = i;
  }
  return best;
}

/// The poles of the mode of a picked pole, without poles of other modes.
std::vector<std::size_t> members_about(const std::vector<DiagramPole>& diagram, std::size_t picked) {
  std::vector<std::size_t> near;
  const Pole& own = diagram[picked].pole;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    const Pole& pole = diagram[i].pole;
    const bool same = std::abs(pole.frequency_Hz / own.frequency_Hz - 1.0) < kSameModeFrequency &&
                      std::norm(pole.shape.dot(own.shape)) > kSameModeMac;
    if (i == picked || (same && diagram[i].mode < 0 && pole.order != own.order)) near.push_back(i);
  }
  return one_an_order(diagram, near, picked);
}

ModeDeviation deviation_of_choice(const Cluster& mode, const std::vector<DiagramPole>& diagram, std::size_t picked) {
  ModeDeviation deviation;
  const double known = diagram[picked].frequency_std_Hz;
  deviation.frequency_Hz = std::hypot(known, mode.frequency_scatter_Hz);
  deviation.damping_ratio = std::hypot(known / mode.frequency_Hz, mode.damping_ratio_scatter);
  deviation.shape_real = Eigen::VectorXd::Constant(mode.shape.size(), kLeastShapeDeviation);
  for (const std::size_t i : mode.members) {
    const Eigen::VectorXcd& other = diagram[i].pole.shape;
    const Eigen::VectorXcd turned = other * std::polar(1.0, std::arg(other.dot(mode.shape)));
    deviation.shape_real = deviation.shape_real.cwiseMax((turned - mode.shape).cwiseAbs());
  }
  deviation.shape_imag = deviation.shape_real;
  return deviation;
}

void add_mode(Identification& found, std::size_t picked, const Conditioned& conditioned, const Eigen::VectorXd& scale) {
  Cluster mode = summarise(found.diagram, members_about(found.diagram, picked));
  ModeDeviation deviation = deviation_of_choice(mode, found.diagram, picked);
  mode.shape = physical_shape(mode.shape, conditioned.channels, scale, mode.frequency_Hz, mode.damping_ratio);
  for (const std::size_t i : mode.members) found.diagram[i].mode = static_cast<int>(found.modes.size());
  found.modes.push_back(std::move(mode));
  found.deviations.push_back(std::move(deviation));
}

}  // namespace

void take_choices(Identification& found, const std::vector<ModeChoice>& choices, const Conditioned& conditioned,
                  const Eigen::VectorXd& scale) {
  std::vector<bool> stays(found.modes.size(), true);
  std::vector<std::size_t> picked;
  for (const ModeChoice& choice : choices) {
    const auto pole = choice.setup == conditioned.setup ? pole_of_choice(choice, found.diagram) : std::nullopt;
    if (!pole) continue;
    const int mode = found.diagram[*pole].mode;
    if (choice.keep && mode < 0) picked.push_back(*pole);
    if (!choice.keep && mode >= 0) stays[static_cast<std::size_t>(mode)] = false;
  }
  keep_modes(found, stays);
  for (const std::size_t pole : picked)
    if (found.diagram[pole].mode < 0) add_mode(found, pole, conditioned, scale);
}

void require_poles(const std::vector<ModeChoice>& choices, const std::vector<ConditionResult>& results) {
  for (const ModeChoice& choice : choices) {
    const bool has = std::ranges::any_of(results, [&](const ConditionResult& result) {
      return std::ranges::any_of(result.setups, [&](const SetupResult& setup) {
        return setup.conditioned.setup == choice.setup && pole_of_choice(choice, setup.found.diagram);
      });
    });
    if (has) continue;
    throw InputError({choice.file, choice.line, "order"},
                     fmt::format("no pole of setup {} at order {} has {:.6g} Hz and {:.4g} %", choice.setup, choice.order,
                                 choice.frequency_Hz, 100.0 * choice.damping_ratio),
                     "take the line out, or pick modes anew from the poles.csv of this configuration");
  }
}

}  // namespace twindeck::identification
