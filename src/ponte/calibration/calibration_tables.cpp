#include "ponte/calibration/calibration_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twindeck::ponte {

namespace {

using Eigen::Index;

constexpr double kEdge = 1e-3;  ///< [-] part of a range within which a value counts as on its edge

std::string edge_of(double part) { return part < kEdge ? "lower" : part > 1.0 - kEdge ? "upper" : ""; }

double largest(const Eigen::VectorXd& displacement_m) {
  return displacement_m.size() == 0 ? 0.0 : displacement_m.cwiseAbs().maxCoeff();
}

/// Calls write(force, stay's place within it, row among the target's forces) for the forces of one variant.
template <typename Write>
void for_each_force(const Calibration& calibration, const std::string& variant, const Write& write) {
  Index row = 0;
  for (const CalibrationForces& forces : calibration.forces) {
    if (forces.variant != variant) continue;
    for (std::size_t i = 0; i < forces.stays.size(); ++i) write(forces, i, row++);
  }
}

/// The same for masses.
template <typename Write>
void for_each_mass(const Calibration& calibration, const std::string& variant, const Write& write) {
  Index row = 0;
  for (const CalibrationMass& mass : calibration.masses) {
    if (mass.variant == variant) write(mass, row++);
  }
}

std::string used_kinds(const CalibrationTrial& trial) {
  const std::vector<std::string> names = {"frequencies", "forces", "masses", "displacements"};
  std::vector<std::string> used;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (trial.weight[k] > 0.0) used.push_back(names[k]);
  }
  return fmt::format("{}", fmt::join(used, " "));
}

std::string variable(std::string text) {
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

std::vector<std::string> trade_columns(const Calibration& calibration) {
  std::vector<std::string> out = {"trial", "form", "fitted_to", "mesh", "whole_range_costs", "values", "values_on_edge"};
  for (const CalibrationTarget& target : calibration.targets) {
    out.push_back(target.variant + "_rms_pct");
    out.push_back(target.variant + "_worst_pct");
  }
  for (const CalibrationTarget& target : calibration.targets) {
    for_each_force(calibration, target.variant, [&](const CalibrationForces& f, std::size_t i, Index) {
      const std::string column = target.variant + "_" + f.stays[i] + "_kN";
      if (std::find(out.begin(), out.end(), column) == out.end()) out.push_back(column);
    });
  }
  out.push_back("force_worst_pct");
  for (const CalibrationTarget& target : calibration.targets) {
    for_each_mass(calibration, target.variant, [&](const CalibrationMass& mass, Index) {
      out.push_back(target.variant + "_" + variable(mass.known.name) + "_kg_m");
    });
  }
  for (const CalibrationTarget& target : calibration.targets) {
    for (const CalibrationLimit& limit : calibration.limits) {
      if (limit.variant == target.variant) out.push_back(limit.variant + "_anchors_mm");
    }
  }
  for (const std::string kind : {"frequencies", "forces", "masses", "displacements", "values"}) out.push_back("cost_" + kind);
  out.push_back("iterations");
  out.push_back("settled");
  return out;
}

/// rms and largest relative error of each target's frequencies. [%]
void add_frequency_errors(const Calibration& calibration, const CalibrationResult& result, std::vector<io::Cell>& cells) {
  Index row = 0;
  for (const CalibrationTarget& target : calibration.targets) {
    double sum = 0.0, worst = 0.0;
    for (const double printed : target.frequency_Hz) {
      const double error = 100.0 * (result.fitted[row++] / printed - 1.0);
      sum += error * error;
      worst = std::max(worst, std::abs(error));
    }
    cells.emplace_back(std::sqrt(sum / static_cast<double>(target.frequency_Hz.size())));
    cells.emplace_back(worst);
  }
}

}  // namespace

void write_calibration_values(const Calibration& calibration, const CalibrationResult& result,
                              const std::filesystem::path& file) {
  io::CsvWriter csv({"value", "unit", "untuned", "lower", "upper", "fitted", "edge", "reason"});
  for (std::size_t v = 0; v < calibration.values.size(); ++v) {
    const CalibrationValue& value = calibration.values[v];
    const double part = result.part[static_cast<Index>(v)];
    csv.row({value.name, value.unit, value.start, value.lower, value.upper, value.at(part), edge_of(part), value.reason});
  }
  csv.save(file);
}

void write_calibration_frequencies(const Calibration& calibration, const CalibrationResult& result,
                                   const std::filesystem::path& file) {
  io::CsvWriter csv(
      {"variant", "source", "mode", "printed_Hz", "untuned_Hz", "untuned_error_pct", "fitted_Hz", "fitted_error_pct"});
  Index row = 0;
  for (const CalibrationTarget& target : calibration.targets) {
    for (std::size_t i = 0; i < target.modes.size(); ++i, ++row) {
      const double printed = target.frequency_Hz[i];
      csv.row({target.variant, target.source, static_cast<long>(target.modes[i]), printed, result.untuned[row],
               100 * (result.untuned[row] / printed - 1), result.fitted[row], 100 * (result.fitted[row] / printed - 1)});
    }
  }
  csv.save(file);
}

void write_calibration_known(const Calibration& calibration, const CalibrationResult& result,
                             const std::filesystem::path& file) {
  io::CsvWriter csv({"variant", "kind", "name", "source", "unit", "known", "std", "lower", "upper", "untuned", "fitted"});
  const io::Cell none = "";
  for (std::size_t t = 0; t < calibration.targets.size(); ++t) {
    const std::string& variant = calibration.targets[t].variant;
    const updating::StructureAnswer &before = result.untuned_answers[t], &after = result.answers[t];
    for_each_force(calibration, variant, [&](const CalibrationForces& f, std::size_t i, Index row) {
      csv.row({variant, "cable_force", f.stays[i], f.source, "N", f.force_N[i], f.relative_std * f.force_N[i], none, none,
               before.force_N[row], after.force_N[row]});
    });
    for_each_mass(calibration, variant, [&](const CalibrationMass& m, Index row) {
      csv.row({variant, "mass", m.known.name, m.reason, "kg/m", m.known.mass_kg_m, m.known.std_kg_m, m.lower_kg_m, m.upper_kg_m,
               before.mass_kg_m[row], after.mass_kg_m[row]});
    });
    for (const CalibrationLimit& limit : calibration.limits) {
      if (limit.variant != variant) continue;
      csv.row({variant, "displacement", "anchors", limit.reason, "m", none, limit.limit.std_m, none, limit.limit.limit_m,
               largest(before.displacement_m), largest(after.displacement_m)});
    }
  }
  csv.save(file);
}

Eigen::VectorXd starts(const Calibration& calibration) {
  Eigen::VectorXd out(std::ssize(calibration.values));
  for (Index v = 0; v < out.size(); ++v) {
    const CalibrationValue& value = calibration.values[static_cast<std::size_t>(v)];
    out[v] = value.part_of(value.start);
  }
  return out;
}

Eigen::VectorXd parts_in(const std::filesystem::path& values_csv, const Calibration& calibration) {
  const io::CsvTable table =
      io::CsvTable::read(values_csv, {"value", "fitted"}, {"unit", "untuned", "lower", "upper", "edge", "reason"});
  Eigen::VectorXd part = starts(calibration);
  for (std::size_t v = 0; v < calibration.values.size(); ++v) {
    const CalibrationValue& value = calibration.values[v];
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (table.text(row, "value") != value.name) continue;
      const double fitted = table.number(row, "fitted");
      if (!value.linear && fitted <= 0.0)
        table.fail(row, "fitted", "is not above 0, but the value's range is travelled in its logarithm",
                   "give a number above 0");
      part[static_cast<Index>(v)] = std::clamp(value.part_of(fitted), 0.0, 1.0);
    }
  }
  return part;
}

TradeTable::TradeTable(const Calibration& calibration) : csv_(trade_columns(calibration)) {}

void TradeTable::add(const CalibrationTrial& trial, const std::string& mesh, const Calibration& calibration,
                     const CalibrationResult& result) {
  const auto on_edge =
      std::count_if(result.part.begin(), result.part.end(), [](double part) { return !edge_of(part).empty(); });
  std::vector<io::Cell> cells = {trial.name,
                                 trial.form,
                                 used_kinds(trial),
                                 mesh,
                                 trial.whole_range_costs,
                                 calibration.values.size(),
                                 static_cast<long>(on_edge)};
  add_frequency_errors(calibration, result, cells);
  // A stay that two sources name has one force and one column; the worst deviation is that of the first source.
  double worst = 0.0;
  std::vector<std::string> seen;
  for (std::size_t t = 0; t < calibration.targets.size(); ++t) {
    const std::string& variant = calibration.targets[t].variant;
    for_each_force(calibration, variant, [&](const CalibrationForces& f, std::size_t i, Index row) {
      const std::string name = variant + f.stays[i];
      if (std::find(seen.begin(), seen.end(), name) != seen.end()) return;
      seen.push_back(name);
      const double force_N = result.answers[t].force_N[row], error = 100.0 * (force_N / f.force_N[i] - 1.0);
      if (std::abs(error) > std::abs(worst)) worst = error;
      cells.emplace_back(force_N / 1e3);
    });
  }
  cells.emplace_back(worst);
  for (std::size_t t = 0; t < calibration.targets.size(); ++t) {
    for_each_mass(calibration, calibration.targets[t].variant,
                  [&](const CalibrationMass&, Index row) { cells.emplace_back(result.answers[t].mass_kg_m[row]); });
  }
  for (std::size_t t = 0; t < calibration.targets.size(); ++t) {
    if (result.answers[t].displacement_m.size() > 0) cells.emplace_back(1e3 * largest(result.answers[t].displacement_m));
  }
  for (const double cost : result.costs) cells.emplace_back(cost);
  cells.emplace_back(static_cast<long>(result.iterations));
  cells.emplace_back(result.status.converged ? "yes" : "no");
  csv_.row(cells);
}

}  // namespace twindeck::ponte
