#include "ponte/calibration/calibration_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "ponte/definition_file.hpp"

namespace twindeck::ponte {

namespace {

constexpr double kNewtonsPerKilonewton = 1e3;
constexpr double kPerCent = 1e-2;
constexpr double kMetresPerMillimetre = 1e-3;
constexpr DefinitionFile::Range kAny{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
constexpr long kMostModes = 10'000, kMostIterations = 100'000;
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
    out.modes.push_back(static_cast<int>(keys.file.integer(keys.path("modes." + std::to_string(i)), 1, kMostModes)));
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
    const auto found = std::find(kKinds.begin(), kKinds.end(), kind);
    keys.expect(found != kKinds.end(), "use", "names '" + kind + "'", fmt::format("name some of {}", fmt::join(kKinds, ", ")));
    out.weight[static_cast<std::size_t>(found - kKinds.begin())] = 1.0;
  }
  return out;
}

/// What is said of a variant needs a target of that variant, trials the forms that they name.
void check_names(const Calibration& out, const std::string& file) {
  std::vector<std::string> variants, forms;
  for (const CalibrationTarget& target : out.targets) variants.push_back(target.variant);
  for (const CalibrationForm& form : out.forms) forms.push_back(form.name);
  const auto check = [&](const std::vector<std::string>& known, const std::string& name, const std::string& of) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    throw InputError({file, 0, of}, "names '" + name + "'" + did_you_mean(name, known),
                     fmt::format("name one of {}", fmt::join(known, ", ")));
  };
  for (const CalibrationForces& one : out.forces) check(variants, one.variant, "force.variant");
  for (const CalibrationMass& one : out.masses) check(variants, one.variant, "mass.variant");
  for (const CalibrationLimit& one : out.limits) check(variants, one.variant, "displacement.variant");
  for (const CalibrationTrial& one : out.trials) check(forms, one.form, "trial.form");
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
    out.max_iterations = static_cast<int>(file.integer("fit.max_iterations", 1, kMostIterations));
  }
  file.refuse_unknown();
  check_names(out, file.name());
  return out;
}

}  // namespace twindeck::ponte
