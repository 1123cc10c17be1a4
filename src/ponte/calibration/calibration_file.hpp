#pragma once

#include <filesystem>

#include "ponte/calibration/calibration.hpp"

namespace twindeck::ponte {

/// Reads calibration.toml: targets, sizes with their ranges, known forces and masses, forms and trials.
/// @throws InputError naming file and line
[[nodiscard]] Calibration read_calibration(const std::filesystem::path& file);

}  // namespace twindeck::ponte
