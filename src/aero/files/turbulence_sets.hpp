#pragma once

#include <filesystem>
#include <string>

#include "wind/turbulence.hpp"

namespace twindeck::aero {

/// Reads a set by its name from a file such as data/wind/turbulence_sets.csv, whose columns have the paper's letters (v along,
/// u across, w vertical).
/// @throws InputError  for an unknown set, with the nearest name and all names; for a number out of its range
[[nodiscard]] wind::TurbulenceSet read_turbulence_set(const std::filesystem::path& file, const std::string& name);

}  // namespace twindeck::aero
