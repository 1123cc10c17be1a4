#include "steps/shared/measured_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/toml_value.hpp"

namespace twindeck::steps {

namespace {

constexpr double absolute_zero_C = -273.15;

double finite_number(const io::TomlEntry& entry, const Place& place) {
  double value = 0.0;
  if (const auto* number = entry.value.as<double>())
    value = *number;
  else if (const auto* whole = entry.value.as<long>())
    value = static_cast<double>(*whole);
  else
    throw InputError(place, "is " + io::shown(entry.value) + ", expected a number", "write it without quotes and unit");
  if (!std::isfinite(value))
    throw InputError(place, "is " + io::shown(entry.value) + ", expected a finite number", "leave the key out where it is unknown");
  return value;
}

double number_from(const io::TomlEntry& entry, const Place& place, double least) {
  const double value = finite_number(entry, place);
  if (value < least)
    throw InputError(place, fmt::format("is {}, expected a value of at least {}", io::shown(entry.value), io::toml_number(least)),
                     "mend the value, or leave the key out where it is unknown");
  return value;
}

std::string text_of(const io::TomlEntry& entry, const Place& place) {
  if (const auto* text = entry.value.as<std::string>()) return *text;
  throw InputError(place, "is " + io::shown(entry.value) + ", expected text", "write it in quotes");
}

/// Enters one key of a condition's table.
void enter_key(const io::TomlEntry& entry, const Place& place, MeasuredCondition& condition) {
  static const std::vector<std::string> known = {"dampers",  "amplitude_m",   "amplitude_channel", "temperature_C",
                                                 "wind_m_s", "direction_deg", "people"};
  if (entry.key == "dampers") {
    const std::string text = text_of(entry, place);
    if (text != "on" && text != "off")
      throw InputError(place, fmt::format("is '{}', expected \"on\" or \"off\"", text), "say whether the dampers are fitted");
    condition.dampers_on = text == "on";
  } else if (entry.key == "amplitude_channel") {
    condition.amplitude_channel = text_of(entry, place);
  } else if (entry.key == "amplitude_m") {
    condition.amplitude_m = number_from(entry, place, 0.0);
  } else if (entry.key == "temperature_C") {
    condition.temperature_C = number_from(entry, place, absolute_zero_C);
  } else if (entry.key == "wind_m_s") {
    condition.wind_m_s = number_from(entry, place, 0.0);
  } else if (entry.key == "direction_deg") {
    condition.direction_deg = finite_number(entry, place);
  } else if (entry.key == "people") {
    condition.people = number_from(entry, place, 0.0);
  } else {
    throw InputError(place, "is not a known key of a condition" + did_you_mean(entry.key, known),
                     fmt::format("use {}", fmt::join(known, ", ")));
  }
}

}  // namespace

std::vector<Channel> read_channels(const std::filesystem::path& file) {
  const auto table = io::CsvTable::read(
      file, {"channel"}, {"point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role"});
  std::vector<Channel> channels;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Channel channel;
    channel.name = table.text(row, "channel");
    if (channel.name.empty()) table.fail(row, "channel", "is empty", "name the channel");
    for (const Channel& other : channels) {
      if (other.name == channel.name)
        table.fail(row, "channel", fmt::format("'{}' appears twice", channel.name), "remove one of the two rows");
    }
    channel.point = table.text(row, "point");
    if (table.number_if(row, "x_m"))
      channel.x_m = Eigen::Vector3d(table.number(row, "x_m"), table.number(row, "y_m"), table.number(row, "z_m"));
    channel.direction = {table.number_or(row, "dx", 0.0), table.number_or(row, "dy", 0.0), table.number_or(row, "dz", 0.0)};
    const double length = channel.direction.norm();
    if (length > 0.0 && std::abs(length - 1.0) > 0.02) {
      table.fail(row, "dx", fmt::format("direction cosines have length {:.3f}, expected 1", length), "give a unit vector");
    }
    if (length > 0.0) channel.direction /= length;
    channels.push_back(channel);
  }
  return channels;
}

std::vector<MeasuredCondition> read_conditions(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) {
    throw InputError({file.string(), 0, ""}, "is not there, expected one table for each condition of rows.csv",
                     "write the file; the tables may be empty");
  }
  std::vector<MeasuredCondition> conditions;
  for (const io::TomlEntry& entry : io::read_toml(file)) {
    const auto* table = entry.value.as<io::TomlValue::Table>();
    if (table == nullptr) throw InputError({file.string(), entry.line, entry.key}, "is no table", "give one table a condition");
    MeasuredCondition& condition = conditions.emplace_back();
    condition.name = entry.key;
    for (const io::TomlEntry& e : *table) enter_key(e, {file.string(), e.line, e.key}, condition);
  }
  return conditions;
}

std::string choose_condition(const std::filesystem::path& file, const std::vector<MeasuredCondition>& conditions,
                             const std::string& asked) {
  std::vector<std::string> names, off;
  for (const MeasuredCondition& condition : conditions) {
    names.push_back(condition.name);
    if (condition.dampers_on == false) off.push_back(condition.name);
  }
  if (!asked.empty()) {
    if (std::find(names.begin(), names.end(), asked) != names.end()) return asked;
    throw InputError({file.string(), 0, asked}, "is no condition of this file" + did_you_mean(asked, names),
                     "give one of its tables as `condition`");
  }
  if (names.size() == 1) return names.front();
  if (off.size() == 1) return off.front();
  throw InputError({file.string(), 0, ""},
                   fmt::format("has {} conditions, {} of them with dampers = \"off\"", names.size(), off.size()),
                   "name the one to use in the key `condition` of the step");
}

}  // namespace twindeck::steps
