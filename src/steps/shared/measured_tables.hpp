#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "steps/shared/measured.hpp"

/// The tables of a features folder that say where and when was measured.
namespace twindeck::steps {

/// channels.csv: `channel` and, as far as known, `point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role`; of
/// load tests `element,xi` for a strain (y_m, z_m are then the fibre in the section) and `support` for a force.
/// @throws InputError  for a channel named twice, direction cosines that are no unit vector (to 2 %), an unknown unit, or one
///         that the gain contradicts
[[nodiscard]] std::vector<Channel> read_channels(const std::filesystem::path& file);

/// A table of conditions.toml: under which circumstances was measured. What is not known is empty.
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

/// @throws InputError  for a file that is not there, an unknown key, a value of another kind or out of its range
[[nodiscard]] std::vector<MeasuredCondition> read_conditions(const std::filesystem::path& file);

/// Which conditions a step is to look at, by `--condition`, `--state` or its configuration. Empty: not said.
struct ConditionChoice {
  std::string condition, state;
};

/// The states of a file: `reference` first where there is one, then in the order of the file.
[[nodiscard]] std::vector<std::string> states_of(const std::vector<MeasuredCondition>& conditions);

/// The conditions that a choice leaves, all where nothing is said, in their order.
/// @param file  where they stand, for messages
/// @throws InputError  for an unknown condition or state, with the names that there are, and for a condition of another state
[[nodiscard]] std::vector<MeasuredCondition> chosen_conditions(const std::filesystem::path& file,
                                                               const std::vector<MeasuredCondition>& conditions,
                                                               const ConditionChoice& choice);

/// The one condition to read: the chosen one; else, in the chosen state or the first one (states_of), the only one, or the only one with
/// dampers = "off".
/// @throws InputError  as above, and where several are left
[[nodiscard]] std::string choose_condition(const std::filesystem::path& file, const std::vector<MeasuredCondition>& conditions,
                                           const ConditionChoice& choice);

}  // namespace twindeck::steps
