#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "io/toml_value.hpp"
#include "steps/calibration/calibration.hpp"

namespace twindeck::steps {

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

}  // namespace

double CalibrationValue::at(double part) const {
  return linear ? lower + part * (upper - lower) : lower * std::pow(upper / lower, part);
}

double CalibrationValue::part_of(double value) const {
  return linear ? (value - lower) / (upper - lower) : std::log(value / lower) / std::log(upper / lower);
}

Calibration read_calibration(const std::filesystem::path& file) {
  const TomlValue::Table tree = io::read_toml(file);
  Calibration out;
  Reader root(tree, file.string(), 0);
  const auto tables = [&](const std::string& name, const auto& read) {
    const auto* list = root.find<TomlValue::Array>(name);
    if (list == nullptr || list->empty()) root.fail(name, "is missing", "give at least one [[" + name + "]]");
    for (const TomlValue& one : *list) {
      if (const auto* table = one.as<TomlValue::Table>()) read(Reader(*table, file.string(), one.line));
    }
  };
  tables("target", [&](Reader reader) { out.targets.push_back(read_target(std::move(reader))); });
  tables("value", [&](Reader reader) { out.values.push_back(read_value(std::move(reader))); });
  if (const auto* fit = root.find<TomlValue::Table>("fit")) {
    Reader reader(*fit, file.string(), 0);
    out.whole_range_costs = reader.number("whole_range_costs");
    out.max_iterations = static_cast<int>(reader.number("max_iterations"));
    reader.finish();
  }
  root.finish();
  return out;
}

ponte::Values bridge_values(const Calibration& calibration, const Eigen::VectorXd& part) {
  ponte::Values out;
  for (std::size_t v = 0; v < calibration.values.size(); ++v) {
    const CalibrationValue& value = calibration.values[v];
    for (std::size_t p = 0; p < value.paths.size(); ++p) {
      out.emplace(value.paths[p], 1.0).first->second *= value.factors[p] * value.at(part[static_cast<Eigen::Index>(v)]);
    }
  }
  return out;
}

}  // namespace twindeck::steps
