#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "steps/shared/measured.hpp"

/// The tables of a features folder that say where and when was measured.
namespace twindeck::steps {

/// channels.csv: `channel` and, as far as known, `point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role`.
/// @throws InputError  for a channel named twice, or direction cosines that are no unit vector (to 2 %)
[[nodiscard]] std::vector<Channel> read_channels(const std::filesystem::path& file);

/// The condition to read: `asked` if it is a table of conditions.toml; for "" the only one, or the only one with dampers =
/// "off".
/// @throws InputError  for an unknown key or condition, and where "" leaves a choice
[[nodiscard]] std::string choose_condition(const std::filesystem::path& file, const std::string& asked);

}  // namespace twindeck::steps
