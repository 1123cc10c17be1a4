#pragma once

#include <vector>

#include "records/record.hpp"

namespace twindeck::records {

/// Calls the channels of a universal file by the first of their title lines or, where it is empty or one for all, by the next
/// thing that tells them apart: the point of record 6 with its direction, its name, another title line. The others stay names
/// too, if they are unique.
/// @param channels  other_names: the five title lines, then what record 6 gives
void name_by_difference(std::vector<ChannelInfo>& channels);

}  // namespace twindeck::records
