#include "steps/shared/measured_tables.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {

namespace {

struct Condition {
  std::string name, dampers;
};

std::vector<Condition> read_conditions(const std::filesystem::path& file) {
  const std::vector<std::string> known = {"dampers",       "amplitude_m", "amplitude_channel", "temperature_C", "wind_m_s",
                                          "direction_deg", "people"};
  std::vector<Condition> conditions;
  try {
    const toml::table root = toml::parse_file(file.string());
    for (const auto& [name, node] : root) {
      const auto line = static_cast<long>(node.source().begin.line);
      const toml::table* table = node.as_table();
      if (table == nullptr)
        throw InputError({file.string(), line, std::string(name.str())}, "is no table", "give one table a condition");
      for (const auto& [key, value] : *table) {
        if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
        throw InputError({file.string(), static_cast<long>(value.source().begin.line), std::string(key.str())},
                         "is not a known key of a condition" + did_you_mean(key.str(), known), "");
      }
      const std::string dampers = (*table)["dampers"].value_or(std::string());
      if (!dampers.empty() && dampers != "on" && dampers != "off") {
        throw InputError({file.string(), line, "dampers"}, fmt::format("is '{}', expected \"on\" or \"off\"", dampers), "");
      }
      conditions.push_back({std::string(name.str()), dampers});
    }
  } catch (const toml::parse_error& error) {
    throw InputError({file.string(), static_cast<long>(error.source().begin.line), ""}, std::string(error.description()),
                     "mend the TOML");
  }
  return conditions;
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

std::string choose_condition(const std::filesystem::path& file, const std::string& asked) {
  if (!std::filesystem::exists(file)) {
    throw InputError({file.string(), 0, ""}, "is not there, expected one table for each condition of rows.csv",
                     "write the file; the tables may be empty");
  }
  const std::vector<Condition> conditions = read_conditions(file);
  std::vector<std::string> names, off;
  for (const Condition& condition : conditions) {
    names.push_back(condition.name);
    if (condition.dampers == "off") off.push_back(condition.name);
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
