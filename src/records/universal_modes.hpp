#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "matching/measured.hpp"

namespace twindeck::records {

/// Modes that another program identified, of a universal file.
struct UniversalModes {
  modal::ModeSet modes;                     ///< ascending; direction of a dof: the channel's name
  std::vector<matching::Channel> channels;  ///< one a node and direction that moves in some mode, "12_x" at point "12"
  std::vector<std::string> notes;           ///< what is left out
};

/// Real and complex modes of sets 55 at the nodes of sets 15 and 2411, in metres by set 164. A direction that is zero in every
/// mode was not measured and gives no channel. Rotations and results that are no modes are left out with a note.
/// @param std_pct  [%] standard deviation of each frequency, which such a file does not hold; 0: stays unknown (NaN)
/// @throws InputError  for a file without modes, a node without coordinates, modes at different nodes, nodes in different axes
[[nodiscard]] UniversalModes read_universal_modes(const std::filesystem::path& file, double std_pct);

/// channels.csv of channels at points: `channel,point,x_m,y_m,z_m,dx,dy,dz`.
void write_channels(const std::vector<matching::Channel>& channels, const std::filesystem::path& file);

}  // namespace twindeck::records
