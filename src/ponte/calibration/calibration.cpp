#include "ponte/calibration/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/lists.hpp"
#include "fe/model.hpp"

namespace twindeck::ponte {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMeshesAgree = 2e-4;  ///< [-] of each frequency: a tenth of what two decimals of a per cent show
constexpr int kMostRounds = 6;         ///< of search on the quick mesh and correction on the full one

updating::StructureData data_of(const Calibration& calibration, const CalibrationTarget& target) {
  updating::StructureData out;
  out.frequencies.modes = target.modes;
  out.frequencies.frequency_Hz = Eigen::Map<const VectorXd>(target.frequency_Hz.data(), std::ssize(target.frequency_Hz));
  out.frequencies.std = calibration.frequency_std;
  for (const CalibrationForces& forces : calibration.forces)
    for (std::size_t i = 0; forces.variant == target.variant && i < forces.stays.size(); ++i)
      out.forces.push_back({forces.stays[i], forces.force_N[i], forces.relative_std * forces.force_N[i]});
  for (const CalibrationMass& mass : calibration.masses)
    if (mass.variant == target.variant) out.masses.push_back(mass.known);
  for (const CalibrationLimit& limit : calibration.limits)
    if (limit.variant == target.variant) out.limits.push_back(limit.limit);
  return out;
}

/// Whether a value can act on a variant: what only a change sets is not in `preliminary`; what a change sets anew is not in
/// the others.
bool acts(const Calibration& calibration, const CalibrationValue& value, const std::string& variant) {
  return std::ranges::any_of(value.paths, [&](const std::string& path) {
    if (path.starts_with("change.")) return variant != "preliminary";
    if (variant == "preliminary") return true;
    for (const CalibrationValue& other : calibration.values)
      for (const std::string& changed : other.paths)
        if (changed.starts_with("change.") && changed.ends_with("." + path)) return false;
    return true;
  });
}

std::vector<updating::FittedStructure> structures_of(const Calibration& calibration, const std::filesystem::path& bridge_toml,
                                                     const std::string& mesh) {
  std::vector<updating::FittedStructure> out;
  for (const CalibrationTarget& target : calibration.targets) {
    const std::string variant = target.variant;
    out.push_back({[&calibration, bridge_toml, variant, mesh](const VectorXd& part) {
                     return generate_with_values(bridge_toml, variant, mesh, bridge_values(calibration, part));
                   },
                   [&calibration, variant](Index v) {
                     return acts(calibration, calibration.values[static_cast<std::size_t>(v)], variant);
                   },
                   data_of(calibration, target)});
  }
  return out;
}

updating::FitObjective objective_of(const Calibration& calibration) {
  return updating::FitObjective{.weight = calibration.weight,
                                .unit = calibration.frequency_std,
                                .range_costs = calibration.whole_range_costs,
                                .start = starts(calibration)};
}

std::string told(const Calibration& calibration, const updating::StructureFit& fit) {
  double sum = 0.0, worst = 0.0;
  Index row = 0;
  const VectorXd frequency_Hz = fit.frequencies();
  for (const CalibrationTarget& target : calibration.targets) {
    for (const double printed : target.frequency_Hz) {
      const double error = frequency_Hz[row++] / printed - 1.0;
      sum += error * error;
      worst = std::max(worst, std::abs(error));
    }
  }
  double cost = 0.0;
  const auto costs = fit.costs();
  for (const double part : costs) cost += part;
  return fmt::format(
      "rms {:.3f} %, worst {:.2f} %; cost {:.5f}, of it {:.5f} frequencies, {:.5f} forces, {:.5f} masses, "
      "{:.5f} displacements, {:.5f} values",
      100 * std::sqrt(sum / static_cast<double>(row)), 100 * worst, cost, costs[0], costs[1], costs[2], costs[3], costs[4]);
}

}  // namespace

CalibrationResult calibrate(const Calibration& calibration, const std::filesystem::path& bridge_toml, const std::string& mesh,
                            const std::string& search_mesh, const VectorXd& first,
                            const std::function<void(const std::string&)>& report) {
  const auto full_mesh = structures_of(calibration, bridge_toml, mesh),
             quick_mesh = structures_of(calibration, bridge_toml, search_mesh);
  const updating::FitObjective objective = objective_of(calibration);
  updating::StructureFit full(full_mesh, objective), quick(quick_mesh, objective);
  CalibrationResult result;
  VectorXd r;
  if (!full.residual(objective.start, r)) {
    result.status = {false, "the untuned bridge has no modes"};
    return result;
  }
  result.untuned = full.frequencies();
  result.untuned_answers = full.answers();
  result.part = first;
  result.status = {false, "the search, or the frequencies of its mesh beside the other's, do not settle"};
  bool settled = false;
  for (int round = 0; round < kMostRounds; ++round) {
    if (!full.residual(result.part, r)) {
      result.status = {false, "the bridge has no modes at the values found"};
      return result;
    }
    result.fitted = full.frequencies();
    result.answers = full.answers();
    result.costs = full.costs();
    result.cost = 0.5 * r.squaredNorm();
    report(fmt::format("mesh {}: {}", mesh.empty() ? "of the study" : mesh, told(calibration, full)));
    if (settled && (result.fitted - quick.frequencies()).cwiseQuotient(result.fitted).cwiseAbs().maxCoeff() < kMeshesAgree) {
      result.status = {};
      return result;
    }
    quick.ratio.setOnes();
    VectorXd unused;
    if (!quick.residual(result.part, unused)) continue;
    quick.ratio = result.fitted.cwiseQuotient(quick.frequencies());
    const updating::FitSearch found =
        updating::search_fit(quick, result.part, calibration.max_iterations, [&](const updating::FitSearch& at) {
          report(fmt::format("iteration {:2}: {}, projected gradient {:.1e}", at.iterations, told(calibration, quick),
                             at.projected_gradient));
        });
    result.part = found.part;
    result.projected_gradient = found.projected_gradient;
    result.iterations += found.iterations;
    settled = found.settled;
  }
  return result;
}

double CalibrationValue::at(double part) const {
  return linear ? lower + part * (upper - lower) : lower * std::pow(upper / lower, part);
}

double CalibrationValue::part_of(double value) const {
  return linear ? (value - lower) / (upper - lower) : std::log(value / lower) / std::log(upper / lower);
}

Eigen::VectorXd starts(const Calibration& calibration) {
  Eigen::VectorXd out(std::ssize(calibration.values));
  for (Index v = 0; v < out.size(); ++v) {
    const CalibrationValue& value = calibration.values[static_cast<std::size_t>(v)];
    out[v] = value.part_of(value.start);
  }
  return out;
}

Calibration for_trial(Calibration calibration, const std::string& trial) {
  std::vector<std::string> known = each_of(calibration.trials, &CalibrationTrial::name);
  const auto found = std::ranges::find(known, trial);
  if (found == known.end())
    throw InputError({"--trial", 0, trial}, "is no [[trial]] of the calibration" + did_you_mean(trial, known),
                     fmt::format("name one of {}", fmt::join(known, ", ")));
  const CalibrationTrial chosen = calibration.trials[static_cast<std::size_t>(found - known.begin())];
  calibration.weight = chosen.weight;
  calibration.whole_range_costs = chosen.whole_range_costs;
  calibration.set =
      std::ranges::find_if(calibration.forms, [&](const CalibrationForm& form) { return form.name == chosen.form; })->set;
  std::erase_if(calibration.values, [&](const CalibrationValue& value) {
    return std::ranges::all_of(value.paths, [&](const std::string& path) { return calibration.set.contains(path); });
  });
  return calibration;
}

Values bridge_values(const Calibration& calibration, const Eigen::VectorXd& part) {
  Values out = calibration.set;
  for (std::size_t v = 0; v < calibration.values.size(); ++v) {
    const CalibrationValue& value = calibration.values[v];
    for (std::size_t p = 0; p < value.paths.size(); ++p)
      if (!calibration.set.contains(value.paths[p]))
        out.emplace(value.paths[p], 1.0).first->second *= value.factors[p] * value.at(part[static_cast<Eigen::Index>(v)]);
  }
  return out;
}

}  // namespace twindeck::ponte
