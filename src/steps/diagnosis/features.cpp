#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/npy.hpp"
#include "io/toml_value.hpp"
#include "steps/diagnosis/catalogue.hpp"
#include "steps/shared/measured_tables.hpp"

namespace twindeck::steps {

namespace {

using diagnosis::Condition;
using diagnosis::FeatureSet;
using diagnosis::Row;
using diagnosis::RowType;

std::vector<Condition> read_all_conditions(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw InputError({file.string(), 0, ""}, "is not there, expected one table for each condition of rows.csv",
                     "write the file; the tables may be empty");
  const std::vector<std::string> known = {"dampers",       "amplitude_m", "amplitude_channel", "temperature_C", "wind_m_s",
                                          "direction_deg", "people"};
  std::vector<Condition> conditions;
  for (const io::TomlEntry& entry : io::read_toml(file)) {
    const auto* table = entry.value.as<io::TomlValue::Table>();
    if (table == nullptr) throw InputError({file.string(), entry.line, entry.key}, "is no table", "give one table a condition");
    Condition condition;
    condition.name = entry.key;
    for (const io::TomlEntry& e : *table) {
      const auto number = [&] {
        if (const auto* d = e.value.as<double>()) return *d;
        if (const auto* l = e.value.as<long>()) return static_cast<double>(*l);
        throw InputError({file.string(), e.line, e.key}, "is no number", "");
      };
      if (e.key == "dampers") {
        const auto* text = e.value.as<std::string>();
        if (text == nullptr || (*text != "on" && *text != "off"))
          throw InputError({file.string(), e.line, e.key}, "is neither \"on\" nor \"off\"", "");
        condition.dampers_on = *text == "on";
      } else if (e.key == "amplitude_channel") {
        const auto* text = e.value.as<std::string>();
        if (text == nullptr) throw InputError({file.string(), e.line, e.key}, "is no text", "name a channel");
        condition.amplitude_channel = *text;
      } else if (e.key == "amplitude_m")
        condition.amplitude_m = number();
      else if (e.key == "temperature_C")
        condition.temperature_C = number();
      else if (e.key == "wind_m_s")
        condition.wind_m_s = number();
      else if (e.key == "direction_deg")
        condition.direction_deg = number();
      else if (e.key == "people")
        condition.people = number();
      else
        throw InputError({file.string(), e.line, e.key}, "is not a known key of a condition" + did_you_mean(e.key, known), "");
    }
    conditions.push_back(condition);
  }
  return conditions;
}

/// Position of a name, or an error that names the nearest.
int position(const io::CsvTable& table, std::size_t row, const std::string& column, const std::vector<std::string>& names,
             const std::string& file) {
  const std::string text = table.text(row, column);
  const auto at = std::find(names.begin(), names.end(), text);
  if (at == names.end())
    table.fail(row, column, fmt::format("'{}' is not in {}{}", text, file, did_you_mean(text, names)), "add it there");
  return static_cast<int>(at - names.begin());
}

void read_quality(const std::filesystem::path& file, FeatureSet& features) {
  if (!std::filesystem::exists(file)) return;
  const auto table = io::CsvTable::read(file, {"channel"}, {}, true);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string channel = table.text(row, "channel");
    const double samples = table.number_or(row, "samples", 0.0);
    if (samples > 0.0)
      features.clipped[channel] = std::max(features.clipped[channel], table.number_or(row, "clipped", 0.0) / samples);
    features.drift[channel] = std::max(features.drift[channel], std::abs(table.number_or(row, "drift_rms", 0.0)));
  }
}

}  // namespace

FeatureSet read_all_features(const std::filesystem::path& folder) {
  FeatureSet features;
  features.conditions = read_all_conditions(folder / "conditions.toml");
  std::vector<std::string> conditions;
  for (const Condition& condition : features.conditions) conditions.push_back(condition.name);
  if (std::filesystem::exists(folder / "channels.csv")) {
    for (const Channel& channel : read_channels(folder / "channels.csv")) {
      features.channels.push_back(channel.name);
      features.direction.push_back(channel.direction);
    }
  }
  for (const Condition& condition : features.conditions) {
    if (!condition.amplitude_channel.empty() &&
        std::find(features.channels.begin(), features.channels.end(), condition.amplitude_channel) == features.channels.end())
      throw InputError({(folder / "conditions.toml").string(), 0, "amplitude_channel"},
                       fmt::format("'{}' of condition {} is not in channels.csv{}", condition.amplitude_channel, condition.name,
                                   did_you_mean(condition.amplitude_channel, features.channels)),
                       "");
  }
  const auto table =
      io::CsvTable::read(folder / "rows.csv", {"type", "mode", "channel", "condition", "value", "std"}, {"held_out"});
  const bool full = std::filesystem::exists(folder / "covariance.npy");
  std::vector<int> kept;
  std::set<std::string> seen;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    Row row;
    const auto& types = diagnosis::row_type_names();
    const std::string type = table.text(r, "type");
    const auto at = std::find(types.begin(), types.end(), type);
    if (at == types.end())
      table.fail(r, "type", fmt::format("'{}' is not a known type of row{}", type, did_you_mean(type, types)));
    row.type = static_cast<RowType>(at - types.begin());
    row.mode = table.text(r, "mode");
    row.condition = position(table, r, "condition", conditions, "conditions.toml");
    row.value = table.number(r, "value");
    const auto deviation = table.number_if(r, "std");
    if (!full && (!deviation || *deviation <= 0.0))
      table.fail(r, "std", deviation ? fmt::format("is {}, expected a value above 0", *deviation) : "is empty",
                 "state the standard deviation of the value; a row without one can't be weighed");
    row.std = deviation.value_or(0.0);
    row.held_out = table.number_or(r, "held_out", 0.0) != 0.0;
    const bool shape = row.type == RowType::shape || row.type == RowType::shape_imag;
    const bool modal = shape || row.type == RowType::frequency || row.type == RowType::damping;
    if (modal && row.mode.empty()) table.fail(r, "mode", "is empty", "name the mode that the row belongs to");
    if (!shape && row.value <= 0.0 && row.type != RowType::static_displacement)
      table.fail(r, "value", fmt::format("is {}, expected a value above 0", row.value));
    if (row.type == RowType::stay_frequency)
      row.stay = table.text(r, "channel");
    else if (shape || row.type == RowType::rms || row.type == RowType::psd_floor || row.type == RowType::static_displacement)
      row.channel = position(table, r, "channel", features.channels, "channels.csv");
    const std::string key = fmt::format("{}|{}|{}|{}", type, row.mode, table.text(r, "channel"), row.condition);
    if (!seen.insert(key).second) table.fail(r, "type", "this row stands twice", "remove one of the two");
    if (row.type == RowType::static_displacement) continue;
    kept.push_back(static_cast<int>(r));
    features.rows.push_back(row);
  }
  if (features.rows.empty()) throw InputError({(folder / "rows.csv").string(), 0, ""}, "holds no row that can be used", "");
  if (full) {
    const Eigen::MatrixXd covariance = io::read_npy(folder / "covariance.npy");
    if (covariance.rows() != static_cast<Eigen::Index>(table.rows()) || covariance.cols() != covariance.rows())
      throw InputError({(folder / "covariance.npy").string(), 0, ""},
                       fmt::format("is {} x {}, but rows.csv has {} rows", covariance.rows(), covariance.cols(), table.rows()),
                       "");
    features.covariance = covariance(kept, kept);
  }
  read_quality(folder / "quality.csv", features);
  return features;
}

}  // namespace twindeck::steps
