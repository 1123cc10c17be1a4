#pragma once

#include <filesystem>
#include <vector>

#include "sensors/layout.hpp"

/// Files of a study's sensor layout: points.csv and setups.csv (sensors/layout.hpp has their columns).
namespace twindeck::steps {

[[nodiscard]] std::vector<sensors::LayoutPoint> read_points(const std::filesystem::path& file);
/// @throws InputError  for a point or direction that is not known, a channel, or a place and direction, that a setup has twice
[[nodiscard]] std::vector<sensors::LayoutChannel> read_setups(const std::filesystem::path& file,
                                                              const std::vector<sensors::LayoutPoint>& points);

}  // namespace twindeck::steps
