#pragma once

#include <filesystem>

#include "identification/condition.hpp"

namespace twindeck::steps {

/// The modes for other programs, on the points of channels.csv: modes.unv (universal file: sets 151, 164, 2411 and a complex
/// set 55 a mode) and modes.vtu (points, and for each mode the real part as a vector field). At each point the vector is the
/// shortest that gives what its channels show along their direction cosines. Nothing is written where fewer than one point has
/// a position and a direction.
void write_mode_exports(const identification::ConditionResult& result, const std::filesystem::path& folder);

}  // namespace twindeck::steps
