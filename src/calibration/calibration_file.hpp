#pragma once

#include <filesystem>

#include "calibration/calibration.hpp"

namespace twindeck::calibration {

/// Reads calibration.toml: targets, sizes with their ranges, known forces and masses, forms and trials.
/// @throws InputError naming file and line
[[nodiscard]] Calibration read_calibration(const std::filesystem::path& file);

}  // namespace twindeck::calibration
