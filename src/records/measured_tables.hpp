#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "matching/measured.hpp"

/// The tables of a features folder with the channels and conditions of the measurement.
namespace twindeck::records {

/// channels.csv: `channel` and, as far as known, `point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role`; of
/// load tests `element,xi` for a strain (y_m, z_m are then the fibre in the section) and `support` for a force.
/// @throws InputError  for a channel named twice, direction cosines that are not a unit vector (within 2 %), an unknown unit,
/// or one that the gain contradicts
[[nodiscard]] std::vector<matching::Channel> read_channels(const std::filesystem::path& file);

/// A table of conditions.toml: the circumstances of a measurement. Unknown values are empty.
struct MeasuredCondition {
  std::string name;
  std::string state = "reference";  ///< the structure as it was then: conditions of one state share it
  long line = 0;                    ///< of conditions.toml
  std::optional<bool> dampers_on;
  std::optional<double> amplitude_m;  ///< RMS displacement at `amplitude_channel`
  std::string amplitude_channel;
  std::string load;    ///< load case of a load test
  long load_line = 0;  ///< of conditions.toml
  std::optional<double> temperature_C, wind_m_s, direction_deg, people;
};

/// @throws InputError  for a missing file, an unknown key, a value of another type or out of range
[[nodiscard]] std::vector<MeasuredCondition> read_conditions(const std::filesystem::path& file);

/// The conditions that a step uses, from `--condition`, `--state` or its configuration. Empty: not said.
struct ConditionChoice {
  std::string condition, state;
};

/// The states of a file: `reference` first if it exists, then in the order of the file.
[[nodiscard]] std::vector<std::string> states_of(const std::vector<MeasuredCondition>& conditions);

/// The conditions that match a choice, in their order; all if the choice is empty.
/// @param file  their file, for messages
/// @throws InputError  for an unknown condition or state, with the names that there are, and for a condition of another state
[[nodiscard]] std::vector<MeasuredCondition> chosen_conditions(const std::filesystem::path& file,
                                                               const std::vector<MeasuredCondition>& conditions,
                                                               const ConditionChoice& choice);

/// The one condition to read: the chosen one; else, in the chosen state or the first one (states_of), the only one, or the only
/// one with dampers = "off".
/// @throws InputError  as above, and if several conditions match
[[nodiscard]] std::string choose_condition(const std::filesystem::path& file, const std::vector<MeasuredCondition>& conditions,
                                           const ConditionChoice& choice);

}  // namespace twindeck::records
