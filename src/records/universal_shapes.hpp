#pragma once

#include "records/universal.hpp"
#include "records/universal_lines.hpp"

namespace twindeck::records {

/// Reads the rest of a set of geometry, shapes or units (15, 2411, 2412, 82, 55, 164), whose number has been read.
/// @return false for any other set, of which nothing is read
/// @throws InputError  with file and line for a set that breaks off or a field that is no number
bool read_shape_set(UniversalLines& in, long set, UniversalData& data);

}  // namespace twindeck::records
