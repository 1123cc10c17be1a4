#pragma once

#include <map>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "ponte/bridge_definition.hpp"

namespace twindeck::ponte {

/// Collects the parts of the model under names; ids of nodes and elements count from 1 in the order of building.
class ModelBuilder {
 public:
  fe::Model model;

  int add_node(const Eigen::Vector3d& x_m);
  int add_material(const fe::Material& material);
  int add_section(const fe::Section& section);
  [[nodiscard]] int material(const std::string& name) const { return materials_.at(name); }
  [[nodiscard]] int section(const std::string& name) const { return sections_.at(name); }
  [[nodiscard]] const Eigen::Vector3d& x(int node) const { return model.nodes[static_cast<std::size_t>(node)].x_m; }

  /// An element; the group has the name of its section unless told otherwise.
  void add_element(fe::ElementType type, const std::string& section, const std::string& material, std::vector<int> nodes,
                   const Eigen::Vector3d& orientation = Eigen::Vector3d::Zero());
  /// A solid of eight nodes (see fe/solid.hpp for their order).
  void add_solid(const std::string& group, const std::string& material, std::vector<int> nodes);
  /// A straight member between two nodes, in `pieces` beams.
  void add_member(const std::string& section, int from, int to, int pieces,
                  const Eigen::Vector3d& orientation = Eigen::Vector3d::Zero(), const std::string& material = "steel");
  /// @param node2  the other end; -1: ground
  void add_spring(const std::string& group, const std::string& name, int node, const Eigen::Vector3d& direction,
                  double stiffness_N_m, int node2 = -1);

 private:
  std::map<std::string, int> materials_, sections_;
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

/// Truss, slab, brackets and non-structural mass of a deck. The truss has one bottom chord (a triangle) or two (a trapezoid or
/// a rectangle, with a strut and a brace across at each station and a diagonal in the bottom plane of each panel).
[[nodiscard]] DeckNodes build_deck(ModelBuilder& builder, const DeckDefinition& deck, const MeshDefinition& mesh);
/// Nodes of the two ends that the decks' bearings lean on: the middle of the end blocks' front faces; -1: they stand on the
/// ground.
struct EndNodes {
  int north = -1, south = -1;
};
/// End blocks of solids, the pier below each and the ramp behind it; nothing if the definition has no ends.
[[nodiscard]] EndNodes build_ends(ModelBuilder& builder, const BridgeDefinition& definition);
/// Springs of both ends: groups foot_north, foot_south, cycle_north, cycle_south. With end blocks each bearing stands on a node
/// at its own place that moves with the block as a rigid body.
void build_deck_supports(ModelBuilder& builder, const DeckDefinition& deck, const DeckNodes& nodes, const EndNodes& ends);

/// Mast: node by height, built in steel and concrete; base fixed, mass at the head.
struct MastNodes {
  std::map<double, int> by_z;
  [[nodiscard]] int at(double z_m) const;  ///< the node at this height, which must be there
  [[nodiscard]] int top() const { return by_z.rbegin()->second; }
};
[[nodiscard]] MastNodes build_mast(ModelBuilder& builder, const BridgeDefinition& definition);

/// Deck stays and the two ground cables, one element each.
void build_stays(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks,
                 const MastNodes& mast);

/// Dampers as inactive springs: groups damper_A, damper_B, damper_C.
void build_dampers(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks);

}  // namespace twindeck::ponte
