#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "steps/shared/measured.hpp"

/// The tables of a features folder that say where and when was measured.
namespace twindeck::steps {

/// channels.csv: `channel` and, as far as known, `point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role`.
/// @throws InputError  for a channel named twice, direction cosines that are no unit vector (to 2 %), an unknown unit, or one
///         that the gain contradicts
[[nodiscard]] std::vector<Channel> read_channels(const std::filesystem::path& file);

/// A table of conditions.toml: under which circumstances was measured. What is not known is empty.
struct MeasuredCondition {
  std::string name;
  std::optional<bool> dampers_on;
  std::optional<double> amplitude_m;  ///< RMS displacement at `amplitude_channel`
  std::string amplitude_channel;
  std::string load;    ///< load case of a load test
  long load_line = 0;  ///< of conditions.toml
  std::optional<double> temperature_C, wind_m_s, direction_deg, people;
};

/// @throws InputError  for a file that is not there, an unknown key, a value of another kind or out of its range
[[nodiscard]] std::vector<MeasuredCondition> read_conditions(const std::filesystem::path& file);

/// The condition to read: `asked` if it is one of them; for "" the only one, or the only one with dampers = "off".
/// @param file  where they stand, for messages
/// @throws InputError  for an unknown condition, and where "" leaves a choice
[[nodiscard]] std::string choose_condition(const std::filesystem::path& file, const std::vector<MeasuredCondition>& conditions,
                                           const std::string& asked);

}  // namespace twindeck::steps
