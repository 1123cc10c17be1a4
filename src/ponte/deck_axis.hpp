#pragma once

#include <Eigen/Core>
#include <vector>

#include "ponte/bridge_definition.hpp"

namespace twindeck::ponte {

/// Arc of a deck in space; the equations stand at the head of bridge.toml.
struct DeckAxis {
  double radius_m, length_m, end_y_m, crown_z_m, rise_m;
  explicit DeckAxis(const DeckDefinition& deck);
  /// @param s_m  arc length from mid-length  @param v_m  radial offset, outward  @param w_m  offset upwards
  [[nodiscard]] Eigen::Vector3d point(double s_m, double v_m = 0.0, double w_m = 0.0) const;
  [[nodiscard]] Eigen::Vector3d radial(double s_m) const;
  [[nodiscard]] Eigen::Vector3d tangent(double s_m) const;
};

/// Distance of the stays from mid-length: (i - 1/2) spacing, the last one last_spacing beyond. [m] (count)
[[nodiscard]] std::vector<double> stay_positions(const StayRow& stay);
/// Stations of the truss, by rising s: every stay, mid-length and both ends, and between them the fewest equal panels that are
/// not longer than spacing / panels_per_stay_spacing. [m]
[[nodiscard]] std::vector<double> stations(const DeckDefinition& deck, int panels_per_stay_spacing);

}  // namespace twindeck::ponte
