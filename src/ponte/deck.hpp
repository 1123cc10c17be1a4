#pragma once

#include <map>
#include <string>
#include <vector>

#include "ponte/bridge_definition.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

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

}  // namespace twindeck::ponte
