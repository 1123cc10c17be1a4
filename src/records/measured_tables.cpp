#include "records/measured_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"
#include "io/path_name.hpp"
#include "io/toml_value.hpp"
#include "records/recorded_unit.hpp"

namespace twindeck::records {

namespace {

constexpr double absolute_zero_C = -273.15;
/// Asphalt and dark steel in the sun reach 70 to 80 degrees. A temperature in kelvin above -20 degrees C is larger than this.
constexpr double hottest_C = 150.0;
constexpr const char* reference_state = "reference";  ///< state of a condition that names none

double finite_number(const io::TomlEntry& entry, const Place& place) {
  const auto value = io::number_of(entry.value);
  if (!value)
    throw InputError(place, "is " + io::shown(entry.value) + ", expected a number", "write it without quotes and unit");
  if (!std::isfinite(*value))
    throw InputError(place, "is " + io::shown(entry.value) + ", expected a finite number",
                     "leave the key out where it is unknown");
  return *value;
}

double number_from(const io::TomlEntry& entry, const Place& place, double least) {
  const double value = finite_number(entry, place);
  if (value < least)
    throw InputError(place,
                     fmt::format("is {}, expected a value of at least {}", io::shown(entry.value), io::toml_number(least)),
                     "mend the value, or leave the key out where it is unknown");
  return value;
}

void enter_key(const io::TomlEntry& entry, const Place& place, MeasuredCondition& condition) {
  static const std::vector<std::string> known = {
      "dampers", "amplitude_m", "amplitude_channel", "temperature_C", "wind_m_s", "direction_deg", "people", "load", "state"};
  if (entry.key == "dampers") {
    const std::string text = io::text_of(entry.value, place);
    if (text != "on" && text != "off")
      throw InputError(place, fmt::format("is '{}', expected \"on\" or \"off\"", text), "say whether the dampers are fitted");
    condition.dampers_on = text == "on";
  } else if (entry.key == "amplitude_channel") {
    condition.amplitude_channel = io::text_of(entry.value, place);
  } else if (entry.key == "load") {
    condition.load = io::text_of(entry.value, place);
    condition.load_line = place.line;
  } else if (entry.key == "state") {
    condition.state = io::text_of(entry.value, place);
    if (condition.state.empty())
      throw InputError(place, "is empty, expected the name of a state of the structure", "leave the key out for \"reference\"");
  } else if (entry.key == "amplitude_m") {
    condition.amplitude_m = number_from(entry, place, 0.0);
  } else if (entry.key == "temperature_C") {
    condition.temperature_C = number_from(entry, place, absolute_zero_C);
    if (*condition.temperature_C > hottest_C)
      throw InputError(
          place,
          fmt::format("is {}, expected a temperature of at most {:.0f} degrees Celsius", io::shown(entry.value), hottest_C),
          "take 273.15 away if it is in kelvin, or leave the key out where it is unknown");
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

void check_word(const io::CsvTable& table, std::size_t row, const std::string& column, const std::vector<std::string>& known) {
  const std::string text = table.text(row, column);
  if (text.empty() || contains(known, text)) return;
  table.fail(row, column, fmt::format("is '{}'{}", text, did_you_mean(text, known)),
             fmt::format("use one of {}, or leave the cell empty", fmt::join(known, ", ")));
}

/// Columns that features carry along from their campaign. They scale nothing here, but must not contradict each other.
void check_origin(const io::CsvTable& table, std::size_t row) {
  check_word(table, row, "quantity", {"acceleration", "velocity", "displacement", "force", "rotation", "strain"});
  check_word(table, row, "role", {"response", "input"});
  check_word(table, row, "reference", {"0", "1"});
  const double gain = table.number_or(row, "gain", 1.0);
  if (gain == 0.0)
    table.fail(row, "gain", "is 0, expected the factor from recorded to physical values", "leave it empty for 1");
  const std::string unit = table.text(row, "unit");
  if (unit.empty()) return;
  const auto known = records::recorded_unit(unit);
  if (!known)
    table.fail(row, "unit", fmt::format("is '{}', which is no unit of a record", unit), "leave it empty if it is not known");
  const double ratio = known->si_factor > 0.0 ? std::abs(gain) / known->si_factor : 1.0;
  if (ratio > kLargestCalibration || ratio < 1.0 / kLargestCalibration)
    table.fail(row, "gain",
               fmt::format("is {:.6g}, but the unit is '{}', which takes {:.6g} to SI units", gain, unit, known->si_factor),
               "correct the gain or the unit");
}

Eigen::Vector3d read_direction(const io::CsvTable& table, std::size_t row) {
  const bool given = table.number_if(row, "dx") || table.number_if(row, "dy") || table.number_if(row, "dz");
  const Eigen::Vector3d direction{table.number_or(row, "dx", 0.0), table.number_or(row, "dy", 0.0),
                                  table.number_or(row, "dz", 0.0)};
  const double length = direction.norm();
  if (given && length == 0.0)
    table.fail(row, "dx", "dx, dy, dz are all 0: a channel measures along some direction",
               "give its direction cosines, or leave the three cells empty");
  if (given && std::abs(length - 1.0) > 0.02)
    table.fail(row, "dx", fmt::format("direction cosines have length {:.3g}, expected 1", length), "give a unit vector");
  return given ? Eigen::Vector3d(direction / length) : direction;
}

/// Where a strain or force gauge of a load test sits.
void read_gauge(const io::CsvTable& table, std::size_t row, matching::Channel& channel) {
  channel.element = table.text(row, "element");
  channel.support = table.text(row, "support");
  if (!channel.element.empty() && !channel.support.empty())
    table.fail(row, "support", "stands beside an element: a channel measures a strain or a force",
               "empty one of the two cells");
  if (channel.element.empty()) {
    if (table.number_if(row, "xi"))
      table.fail(row, "xi", "is given without an element", "name the element that the gauge is on");
    return;
  }
  if (table.number_if(row, "x_m"))
    table.fail(row, "x_m", "is given beside an element: a strain gauge sits at xi along it, and y_m, z_m are in its section",
               "empty the cell");
  channel.xi = table.number_or(row, "xi", channel.xi);
  if (!(channel.xi >= 0.0 && channel.xi <= 1.0))
    table.fail(row, "xi", fmt::format("is {}, expected a part of the element's length from 0 to 1", table.text(row, "xi")),
               "0.5 is the middle");
  channel.fibre_m = {table.number_or(row, "y_m", 0.0), table.number_or(row, "z_m", 0.0)};
}

}  // namespace

std::vector<matching::Channel> read_channels(const std::filesystem::path& file) {
  const auto table = io::CsvTable::read(file, {"channel"},
                                        {"point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain",
                                         "reference", "role", "element", "xi", "support"});
  std::vector<matching::Channel> channels;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    matching::Channel channel;
    channel.name = table.text(row, "channel");
    io::check_inner_name(channel.name, "channel", {file.string(), table.line(row), "channel"});
    for (const matching::Channel& other : channels)
      if (other.name == channel.name)
        table.fail(row, "channel", fmt::format("'{}' appears twice", channel.name), "remove one of the two rows");
    channel.point = table.text(row, "point");
    channel.line = table.line(row);
    read_gauge(table, row, channel);
    if (channel.element.empty() && table.number_if(row, "x_m"))
      channel.x_m = Eigen::Vector3d(table.number(row, "x_m"), table.number(row, "y_m"), table.number(row, "z_m"));
    channel.direction = read_direction(table, row);
    check_origin(table, row);
    channels.push_back(channel);
  }
  return channels;
}

std::vector<MeasuredCondition> read_conditions(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw InputError({file.string(), 0, ""}, "is not there, expected one table for each condition of rows.csv",
                     "write the file; the tables may be empty");
  std::vector<MeasuredCondition> conditions;
  for (const io::TomlEntry& entry : io::read_toml(file)) {
    const auto* table = entry.value.as<io::TomlValue::Table>();
    if (table == nullptr) throw InputError({file.string(), entry.line, entry.key}, "is no table", "give one table a condition");
    MeasuredCondition& condition = conditions.emplace_back();
    condition.name = entry.key;
    condition.line = entry.line;
    for (const io::TomlEntry& e : *table) enter_key(e, {file.string(), e.line, e.key}, condition);
  }
  return conditions;
}

std::vector<std::string> states_of(const std::vector<MeasuredCondition>& conditions) {
  std::vector<const MeasuredCondition*> in_file;
  for (const MeasuredCondition& condition : conditions) in_file.push_back(&condition);
  std::ranges::stable_sort(in_file, [](const auto* a, const auto* b) { return a->line < b->line; });
  std::vector<std::string> states;
  for (const MeasuredCondition* condition : in_file)
    if (!contains(states, condition->state)) states.push_back(condition->state);
  const auto reference = std::ranges::find(states, reference_state);
  if (reference != states.end()) std::rotate(states.begin(), reference, reference + 1);
  return states;
}

std::vector<MeasuredCondition> chosen_conditions(const std::filesystem::path& file,
                                                 const std::vector<MeasuredCondition>& conditions,
                                                 const ConditionChoice& choice) {
  const std::vector<std::string> states = states_of(conditions), names = each_of(conditions, &MeasuredCondition::name);
  if (!choice.state.empty() && !contains(states, choice.state))
    throw InputError({file.string(), 0, choice.state}, "is no state of this file" + did_you_mean(choice.state, states),
                     fmt::format("it has {}: give one of them as --state", fmt::join(states, ", ")));
  if (!choice.condition.empty() && !contains(names, choice.condition))
    throw InputError(
        {file.string(), 0, choice.condition}, "is no condition of this file" + did_you_mean(choice.condition, names),
        fmt::format("it has {}: give one of them as --condition, or in the key `condition`", fmt::join(names, ", ")));
  std::vector<MeasuredCondition> chosen;
  for (const MeasuredCondition& condition : conditions) {
    if (!choice.condition.empty() && condition.name != choice.condition) continue;
    if (!choice.state.empty() && condition.state != choice.state) {
      if (choice.condition.empty()) continue;
      throw InputError({file.string(), condition.line, condition.name},
                       fmt::format("is a condition of state '{}', not of '{}'", condition.state, choice.state),
                       "leave --state or --condition out");
    }
    chosen.push_back(condition);
  }
  return chosen;
}

std::string choose_condition(const std::filesystem::path& file, const std::vector<MeasuredCondition>& conditions,
                             const ConditionChoice& choice) {
  ConditionChoice complete = choice;
  if (choice.condition.empty() && choice.state.empty() && !conditions.empty()) complete.state = states_of(conditions).front();
  std::vector<std::string> names, off;
  bool dampers = false;
  for (const MeasuredCondition& condition : chosen_conditions(file, conditions, complete)) {
    names.push_back(condition.name);
    dampers = dampers || condition.dampers_on.has_value();
    if (condition.dampers_on == false) off.push_back(condition.name);
  }
  if (names.size() == 1) return names.front();
  if (off.size() == 1) return off.front();
  const std::string of_state = states_of(conditions).size() > 1 ? fmt::format(" of state '{}'", complete.state) : std::string();
  throw InputError({file.string(), 0, ""},
                   fmt::format("has {} conditions{}{}", names.size(), of_state,
                               dampers ? fmt::format(", {} of them with dampers = \"off\"", off.size()) : std::string()),
                   names.empty() ? "add a table for each condition of rows.csv"
                                 : fmt::format("give one of {} as --condition, or in the key `condition` of the step; setups "
                                               "of one test are joined where campaign.toml gives them one condition",
                                               fmt::join(names, ", ")));
}

}  // namespace twindeck::records
