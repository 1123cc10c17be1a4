#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "ponte/bridge_definition.hpp"
#include "ponte/model_builder.hpp"

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

/// Nodes of a deck that other parts attach to.
struct DeckNodes {
  struct Line {  ///< a row of slab nodes across the deck
    double s_m;
    std::vector<int> across;  ///< from the inner edge (front) to the outer edge (back): both edges of the slab
    std::vector<int> chord;   ///< top-chord nodes, inner and outer: the ends of `across`, or below them by the slab's height
    std::vector<int> bottom;  ///< bottom-chord nodes, one or, from inner to outer, two; none between stations
  };
  std::vector<Line> lines;             ///< by rising s
  std::map<std::string, int> anchors;  ///< stay name -> bracket node

  /// The station (line with a bottom node) nearest to s.
  [[nodiscard]] const Line& station_near(double s_m) const;
  /// The line, with or without a bottom node, nearest to s.
  [[nodiscard]] const Line& line_near(double s_m) const;
};

/// Truss, slab, brackets and non-structural mass of a deck. The truss has one bottom chord (a triangle) or two (a trapezoid or
/// a rectangle, with a strut and a brace across at each station and a diagonal in the bottom plane of each panel).
[[nodiscard]] DeckNodes build_deck(ModelBuilder& builder, const DeckDefinition& deck, const MeshDefinition& mesh);

/// Distance of the stays from mid-length: (i - 1/2) spacing, the last one last_spacing beyond. [m] (count)
[[nodiscard]] std::vector<double> stay_positions(const StayRow& stay);
/// Stations of the truss, by rising s: every stay, mid-length and both ends, and between them the fewest equal panels that are
/// not longer than spacing / panels_per_stay_spacing. [m]
[[nodiscard]] std::vector<double> stations(const DeckDefinition& deck, int panels_per_stay_spacing);

}  // namespace twindeck::ponte
