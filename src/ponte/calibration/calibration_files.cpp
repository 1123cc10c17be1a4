#include "ponte/calibration/calibration_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/lists.hpp"
#include "ponte/definition_file.hpp"

namespace twindeck::ponte {

namespace {

constexpr double kNewtonsPerKilonewton = 1e3;
constexpr double kPerCent = 1e-2;
constexpr double kMetresPerMillimetre = 1e-3;
constexpr DefinitionFile::Range kAny{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
constexpr int kMostModes = 10'000, kMostIterations = 100'000;
/// Names of updating::DataKind in `use` of a trial, in its order.
const std::vector<std::string> kKinds = {"frequencies", "forces", "masses", "displacements"};

/// One table of the file, whose keys are asked for by name.
struct Keys {
  DefinitionFile& file;
  std::string table;

  [[nodiscard]] std::string path(const std::string& key) const { return table + "." + key; }
  [[nodiscard]] std::string text(const std::string& key) const { return file.text(path(key)); }
  [[nodiscard]] std::vector<std::string> texts(const std::string& key) const { return file.texts(path(key)); }
  [[nodiscard]] double number(const std::string& key) const { return file.number(path(key), "", kAny); }
  [[nodiscard]] std::vector<double> numbers(const std::string& key) const { return file.numbers(path(key), "", kAny); }
  void expect(bool holds, const std::string& key, const std::string& problem, const std::string& mend) const {
    if (!holds) file.fail(path(key), problem, mend);
  }
};

CalibrationValue read_value(const Keys& keys) {
  CalibrationValue out{keys.text("name"),       keys.text("unit"),    keys.text("reason"),  keys.texts("paths"),
                       keys.numbers("factors"), keys.number("start"), keys.number("lower"), keys.number("upper")};
  if (out.factors.empty()) out.factors.assign(out.paths.size(), 1.0);
  keys.expect(out.factors.size() == out.paths.size(), "factors", "are not as many as paths", "give one a path, or none");
  out.linear = keys.file.has(keys.path("scale")) && keys.text("scale") == "linear";
  keys.expect(out.lower < out.upper && out.lower <= out.start && out.start <= out.upper, "start",
              "of " + out.name + " needs lower <= start <= upper and lower < upper", "correct the range or the start");
  keys.expect(out.linear || out.lower > 0.0, "lower", "of " + out.name + " makes a range that reaches 0",
              "say scale = \"linear\"");
  return out;
}

CalibrationTarget read_target(const Keys& keys) {
  CalibrationTarget out{keys.text("variant"), keys.text("source"), {}, keys.numbers("frequency_Hz")};
  for (std::size_t i = 0; i < keys.file.size(keys.path("modes")); ++i)
    out.modes.push_back(keys.file.integer(keys.path("modes." + std::to_string(i)), 1, kMostModes));
  keys.expect(out.modes.size() == out.frequency_Hz.size() && !out.modes.empty(), "frequency_Hz", "are not as many as modes",
              "give one frequency a mode");
  return out;
}

CalibrationForces read_forces(const Keys& keys) {
  CalibrationForces out{keys.text("variant"), keys.text("source"),      keys.text("reason"),
                        keys.texts("stays"),  keys.numbers("force_kN"), kPerCent * keys.number("std_pct")};
  keys.expect(out.stays.size() == out.force_N.size() && !out.stays.empty(), "force_kN", "are not as many as stays",
              "give one force a stay");
  keys.expect(out.relative_std > 0.0, "std_pct", "is not above 0", "give the standard deviation of a force");
  for (double& force : out.force_N) force *= kNewtonsPerKilonewton;
  return out;
}

CalibrationMass read_mass(const Keys& keys) {
  CalibrationMass out{
      keys.text("variant"),
      keys.text("reason"),
      {keys.text("name"), keys.texts("groups"), keys.number("length_m"), keys.number("mass_kg_m"), keys.number("std_kg_m")},
      keys.number("lower_kg_m"),
      keys.number("upper_kg_m")};
  keys.expect(out.known.std_kg_m > 0.0 && out.known.length_m > 0.0, "name", "needs std_kg_m and length_m above 0",
              "correct them");
  keys.expect(out.lower_kg_m < out.upper_kg_m, "lower_kg_m", "is not below upper_kg_m", "correct the range");
  return out;
}

CalibrationLimit read_limit(const Keys& keys) {
  CalibrationLimit out{keys.text("variant"),
                       keys.text("reason"),
                       {kMetresPerMillimetre * keys.number("limit_mm"), kMetresPerMillimetre * keys.number("std_mm")}};
  keys.expect(out.limit.limit_m >= 0.0 && out.limit.std_m > 0.0, "limit_mm", "needs limit_mm of 0 or more and std_mm above 0",
              "correct them");
  return out;
}

CalibrationTrial read_trial(const Keys& keys) {
  CalibrationTrial out{keys.text("name"), keys.text("form"), {}, keys.number("whole_range_costs")};
  for (const std::string& kind : keys.texts("use")) {
    const auto found = std::ranges::find(kKinds, kind);
    keys.expect(found != kKinds.end(), "use", "names '" + kind + "'", fmt::format("name some of {}", fmt::join(kKinds, ", ")));
    out.weight[static_cast<std::size_t>(found - kKinds.begin())] = 1.0;
  }
  return out;
}

/// What is said of a variant needs a target of that variant, trials the forms that they name.
void check_names(const Calibration& out, const std::string& file) {
  const auto variants = each_of(out.targets, &CalibrationTarget::variant);
  const auto forms = each_of(out.forms, &CalibrationForm::name);
  const auto check = [&](const std::vector<std::string>& known, const std::string& name, const std::string& of) {
    if (contains(known, name)) return;
    throw InputError({file, 0, of}, "names '" + name + "'" + did_you_mean(name, known),
                     fmt::format("name one of {}", fmt::join(known, ", ")));
  };
  for (const CalibrationForces& one : out.forces) check(variants, one.variant, "force.variant");
  for (const CalibrationMass& one : out.masses) check(variants, one.variant, "mass.variant");
  for (const CalibrationLimit& one : out.limits) check(variants, one.variant, "displacement.variant");
  for (const CalibrationTrial& one : out.trials) check(forms, one.form, "trial.form");
}

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
  for (const CalibrationMass& mass : calibration.masses)
    if (mass.variant == variant) write(mass, row++);
}

std::string used_kinds(const CalibrationTrial& trial) {
  std::vector<std::string> used;
  for (std::size_t k = 0; k < kKinds.size(); ++k)
    if (trial.weight[k] > 0.0) used.push_back(kKinds[k]);
  return fmt::format("{}", fmt::join(used, " "));
}

std::string variable(std::string text) {
  std::ranges::replace(text, ' ', '_');
  return text;
}

std::vector<std::string> trade_columns(const Calibration& calibration) {
  std::vector<std::string> out = {"trial", "form", "fitted_to", "mesh", "whole_range_costs", "values", "values_on_edge"};
  for (const CalibrationTarget& target : calibration.targets) {
    out.push_back(target.variant + "_rms_pct");
    out.push_back(target.variant + "_worst_pct");
  }
  for (const CalibrationTarget& target : calibration.targets)
    for_each_force(calibration, target.variant, [&](const CalibrationForces& f, std::size_t i, Index) {
      const std::string column = target.variant + "_" + f.stays[i] + "_kN";
      if (!contains(out, column)) out.push_back(column);
    });
  out.push_back("force_worst_pct");
  for (const CalibrationTarget& target : calibration.targets)
    for_each_mass(calibration, target.variant, [&](const CalibrationMass& mass, Index) {
      out.push_back(target.variant + "_" + variable(mass.known.name) + "_kg_m");
    });
  for (const CalibrationTarget& target : calibration.targets)
    for (const CalibrationLimit& limit : calibration.limits)
      if (limit.variant == target.variant) out.push_back(limit.variant + "_anchors_mm");
  for (const std::string& kind : kKinds) out.push_back("cost_" + kind);
  out.push_back("cost_values");
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

Calibration read_calibration(const std::filesystem::path& path) {
  DefinitionFile file = DefinitionFile::load(path);
  Calibration out;
  const auto tables = [&](const std::string& name, auto& list, const auto& read) {
    for (std::size_t i = 0; i < file.size(name); ++i) list.push_back(read(Keys{file, name + "." + std::to_string(i)}));
  };
  tables("target", out.targets, read_target);
  tables("value", out.values, read_value);
  tables("force", out.forces, read_forces);
  tables("mass", out.masses, read_mass);
  tables("displacement", out.limits, read_limit);
  tables("form", out.forms, [](const Keys& keys) {
    return CalibrationForm{keys.text("name"), keys.text("meaning"), keys.file.numbers_below(keys.path("set"))};
  });
  tables("trial", out.trials, read_trial);
  for (const char* needed : {"target", "value"})
    if (file.size(needed) == 0) file.fail(needed, "is missing", fmt::format("give at least one [[{}]]", needed));
  if (file.has("fit")) {
    const Keys fit{file, "fit"};
    out.frequency_std = kPerCent * fit.number("frequency_std_pct");
    out.whole_range_costs = fit.number("whole_range_costs");
    out.max_iterations = file.integer("fit.max_iterations", 1, kMostIterations);
  }
  file.refuse_unknown();
  check_names(out, file.name());
  return out;
}

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
    for (const CalibrationLimit& limit : calibration.limits)
      if (limit.variant == variant)
        csv.row({variant, "displacement", "anchors", limit.reason, "m", none, limit.limit.std_m, none, limit.limit.limit_m,
                 largest(before.displacement_m), largest(after.displacement_m)});
  }
  csv.save(file);
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
  const auto on_edge = std::ranges::count_if(result.part, [](double part) { return !edge_of(part).empty(); });
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
      if (contains(seen, name)) return;
      seen.push_back(name);
      const double force_N = result.answers[t].force_N[row], error = 100.0 * (force_N / f.force_N[i] - 1.0);
      if (std::abs(error) > std::abs(worst)) worst = error;
      cells.emplace_back(force_N / 1e3);
    });
  }
  cells.emplace_back(worst);
  for (std::size_t t = 0; t < calibration.targets.size(); ++t)
    for_each_mass(calibration, calibration.targets[t].variant,
                  [&](const CalibrationMass&, Index row) { cells.emplace_back(result.answers[t].mass_kg_m[row]); });
  for (std::size_t t = 0; t < calibration.targets.size(); ++t)
    if (result.answers[t].displacement_m.size() > 0) cells.emplace_back(1e3 * largest(result.answers[t].displacement_m));
  for (const double cost : result.costs) cells.emplace_back(cost);
  cells.emplace_back(static_cast<long>(result.iterations));
  cells.emplace_back(result.status.converged ? "yes" : "no");
  csv_.row(cells);
}

}  // namespace twindeck::ponte
