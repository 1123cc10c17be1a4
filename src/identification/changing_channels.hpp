#pragma once

#include <string>
#include <vector>

#include "identification/identification.hpp"

namespace twindeck::identification {

/// Finds channels whose gain, polarity or clock changes within a record. Each quarter of a record is compared with the first
/// one. In a quarter p, the motion y of a mode is that of all channels, weighted by the mode's shape, and channel c takes part
/// by
///
///     H_pc = sum over lines x_c conj(y) / sum |y|²,
///
/// over the spectral lines of the mode in five segments. For a sound channel H_pc / H_1c = 1 in all modes. A change of the gain
/// gives one factor, a reversed sensor one sign, and a clock of another speed a turn in proportion to the frequency. The
/// deviation includes what differs from mode to mode.
/// @return one line for each channel that changes by ten deviations, and by a tenth of its gain or ten degrees at the highest
///         mode; empty with fewer than two modes
[[nodiscard]] std::vector<std::string> changes_within_records(const Conditioned& conditioned, const Identification& found);

}  // namespace twindeck::identification
