#include "ponte/calibration/calibration_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/toml_value.hpp"

namespace twindeck::ponte {

namespace {

using io::TomlValue;

/// The keys of one table, asked for by name; what is not asked for is an unknown key.
class Reader {
 public:
  Reader(const TomlValue::Table& table, std::string file, long line) : table_(table), file_(std::move(file)), line_(line) {}

  template <typename Kind>
  const Kind* find(const std::string& key) {
    known_.push_back(key);
    for (const io::TomlEntry& entry : table_) {
      if (entry.key != key) continue;
      if (const auto* value = entry.value.as<Kind>()) return value;
      throw InputError({file_, entry.line, key}, "is " + io::shown(entry.value) + ", which is of another kind than expected",
                       "see data/ponte_del_mare/calibration.toml for an example");
    }
    return nullptr;
  }
  double number(const std::string& key) {
    for (const io::TomlEntry& entry : table_) {
      if (entry.key == key && entry.value.as<long>() != nullptr) {
        known_.push_back(key);
        return static_cast<double>(*entry.value.as<long>());
      }
    }
    return required(find<double>(key), key);
  }
  std::string text(const std::string& key) { return required(find<std::string>(key), key); }
  /// A table of numbers by path.
  Values values(const std::string& key) {
    Values out;
    const auto* entries = find<TomlValue::Table>(key);
    for (const io::TomlEntry& entry : entries == nullptr ? TomlValue::Table{} : *entries) {
      const long* whole = entry.value.as<long>();
      const double* real = entry.value.as<double>();
      if (whole == nullptr && real == nullptr)
        throw InputError({file_, entry.line, key + "." + entry.key}, "is " + io::shown(entry.value),
                         "give a number in SI units");
      out[entry.key] = whole != nullptr ? static_cast<double>(*whole) : *real;
    }
    return out;
  }
  template <typename Kind, typename Wanted = Kind>
  std::vector<Wanted> list(const std::string& key) {
    std::vector<Wanted> out;
    const auto* entries = find<TomlValue::Array>(key);
    for (const TomlValue& value : entries == nullptr ? TomlValue::Array{} : *entries) {
      const auto* one = value.as<Kind>();
      if (one == nullptr) throw InputError({file_, value.line, key}, "holds " + io::shown(value), "give entries of one kind");
      out.push_back(static_cast<Wanted>(*one));
    }
    return out;
  }
  void finish() const {
    for (const io::TomlEntry& entry : table_) {
      if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
      throw InputError({file_, entry.line, entry.key}, "is an unknown key" + did_you_mean(entry.key, known_),
                       "correct its name");
    }
  }
  [[noreturn]] void fail(const std::string& key, const std::string& problem, const std::string& mend) const {
    throw InputError({file_, line_, key}, problem, mend);
  }

 private:
  template <typename Kind>
  Kind required(const Kind* value, const std::string& key) const {
    if (value == nullptr) fail(key, "is missing", "add this key");
    return *value;
  }

  const TomlValue::Table& table_;
  std::string file_;
  long line_;
  std::vector<std::string> known_;
};

CalibrationValue read_value(Reader reader) {
  CalibrationValue out;
  out.name = reader.text("name");
  out.unit = reader.text("unit");
  out.reason = reader.text("reason");
  out.paths = reader.list<std::string>("paths");
  out.factors = reader.list<double>("factors");
  if (out.factors.empty()) out.factors.assign(out.paths.size(), 1.0);
  if (out.factors.size() != out.paths.size()) reader.fail("factors", "are not as many as paths", "give one a path, or none");
  out.start = reader.number("start");
  out.lower = reader.number("lower");
  out.upper = reader.number("upper");
  const auto* scale = reader.find<std::string>("scale");
  out.linear = scale != nullptr && *scale == "linear";
  if (!(out.lower < out.upper && out.lower <= out.start && out.start <= out.upper)) {
    reader.fail(out.name, "needs lower <= start <= upper and lower < upper", "correct the range or the start");
  }
  if (!out.linear && out.lower <= 0.0) reader.fail(out.name, "has a range that reaches 0", "say scale = \"linear\"");
  reader.finish();
  return out;
}

CalibrationTarget read_target(Reader reader) {
  CalibrationTarget out{reader.text("variant"), reader.text("source"), reader.list<long, int>("modes"),
                        reader.list<double>("frequency_Hz")};
  if (out.modes.size() != out.frequency_Hz.size() || out.modes.empty()) {
    reader.fail("frequency_Hz", "are not as many as modes", "give one frequency a mode");
  }
  reader.finish();
  return out;
}

constexpr double kNewtonsPerKilonewton = 1e3;
constexpr double kPerCent = 1e-2;
constexpr double kMetresPerMillimetre = 1e-3;
/// Names of updating::DataKind in `use` of a trial, in its order.
const std::array<std::string, updating::n_data_kinds> kKinds = {"frequencies", "forces", "masses", "displacements"};

CalibrationForces read_forces(Reader reader) {
  CalibrationForces out{reader.text("variant"),          reader.text("source"),
                        reader.text("reason"),           reader.list<std::string>("stays"),
                        reader.list<double>("force_kN"), kPerCent * reader.number("std_pct")};
  if (out.stays.size() != out.force_N.size() || out.stays.empty())
    reader.fail("force_kN", "are not as many as stays", "give one force a stay");
  if (!(out.relative_std > 0.0)) reader.fail("std_pct", "is not above 0", "give the standard deviation of a force");
  for (double& force : out.force_N) force *= kNewtonsPerKilonewton;
  reader.finish();
  return out;
}

CalibrationMass read_mass(Reader reader) {
  CalibrationMass out{reader.text("variant"),
                      reader.text("reason"),
                      {reader.text("name"), reader.list<std::string>("groups"), reader.number("length_m"),
                       reader.number("mass_kg_m"), reader.number("std_kg_m")},
                      reader.number("lower_kg_m"),
                      reader.number("upper_kg_m")};
  if (!(out.known.std_kg_m > 0.0 && out.known.length_m > 0.0))
    reader.fail(out.known.name, "needs std_kg_m and length_m above 0", "correct them");
  if (!(out.lower_kg_m < out.upper_kg_m)) reader.fail(out.known.name, "needs lower_kg_m < upper_kg_m", "correct the range");
  reader.finish();
  return out;
}

CalibrationLimit read_limit(Reader reader) {
  CalibrationLimit out{reader.text("variant"),
                       reader.text("reason"),
                       {kMetresPerMillimetre * reader.number("limit_mm"), kMetresPerMillimetre * reader.number("std_mm")}};
  if (!(out.limit.limit_m >= 0.0 && out.limit.std_m > 0.0))
    reader.fail("limit_mm", "needs limit_mm of 0 or more and std_mm above 0", "correct them");
  reader.finish();
  return out;
}

CalibrationForm read_form(Reader reader) {
  CalibrationForm out{reader.text("name"), reader.text("meaning"), reader.values("set")};
  reader.finish();
  return out;
}

CalibrationTrial read_trial(Reader reader) {
  CalibrationTrial out{reader.text("name"), reader.text("form"), {}, reader.number("whole_range_costs")};
  for (const std::string& kind : reader.list<std::string>("use")) {
    const auto found = std::find(kKinds.begin(), kKinds.end(), kind);
    if (found == kKinds.end()) {
      reader.fail("use", "names '" + kind + "'", fmt::format("name some of {}", fmt::join(kKinds, ", ")));
    }
    out.weight[static_cast<std::size_t>(found - kKinds.begin())] = 1.0;
  }
  reader.finish();
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

Calibration read_calibration(const std::filesystem::path& file) {
  const TomlValue::Table tree = io::read_toml(file);
  Calibration out;
  Reader root(tree, file.string(), 0);
  const auto tables = [&](const std::string& name, const auto& read, bool needed = false) {
    const auto* list = root.find<TomlValue::Array>(name);
    if (needed && (list == nullptr || list->empty())) root.fail(name, "is missing", "give at least one [[" + name + "]]");
    if (list == nullptr) return;
    for (const TomlValue& one : *list) {
      if (const auto* table = one.as<TomlValue::Table>()) read(Reader(*table, file.string(), one.line));
    }
  };
  tables(
      "target", [&](Reader reader) { out.targets.push_back(read_target(std::move(reader))); }, true);
  tables(
      "value", [&](Reader reader) { out.values.push_back(read_value(std::move(reader))); }, true);
  tables("force", [&](Reader reader) { out.forces.push_back(read_forces(std::move(reader))); });
  tables("mass", [&](Reader reader) { out.masses.push_back(read_mass(std::move(reader))); });
  tables("displacement", [&](Reader reader) { out.limits.push_back(read_limit(std::move(reader))); });
  tables("form", [&](Reader reader) { out.forms.push_back(read_form(std::move(reader))); });
  tables("trial", [&](Reader reader) { out.trials.push_back(read_trial(std::move(reader))); });
  if (const auto* fit = root.find<TomlValue::Table>("fit")) {
    Reader reader(*fit, file.string(), 0);
    out.frequency_std = kPerCent * reader.number("frequency_std_pct");
    out.whole_range_costs = reader.number("whole_range_costs");
    out.max_iterations = static_cast<int>(reader.number("max_iterations"));
    reader.finish();
  }
  root.finish();
  check_names(out, file.string());
  return out;
}

}  // namespace twindeck::ponte
