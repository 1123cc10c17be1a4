#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fe/model.hpp"

namespace twindeck::ponte {

/// One variant of bridge.toml as read: SI units, each number within its range, names checked. The meaning and origin of each
/// number stand in the file itself.

struct MeshDefinition {
  int panels_per_stay_spacing, shells_across, shells_per_panel_along, members_per_panel;
};

struct StayType {
  std::string name;  ///< "44": the diameter [mm]
  double youngs_modulus_Pa, area_m2, mass_per_length_kg_m;
};

struct SlabZone {
  std::string group;  ///< "slab_foot_B", "slab_cycle"
  double until;       ///< outer end of the zone, as a part of half the length
  double thickness_m, bending_inertia_ratio;
  std::string material;
};

struct StayRow {
  int count;  ///< a side
  double spacing_m, last_spacing_m;
  std::string prefix_north, prefix_south, type, last_type;
  double top_anchor_z_m, anchor_pitch_m;
};

struct BearingDefinition {
  double bottom_N_m, vertical_N_m, radial_N_m, tangential_N_m;
};

struct DeckDefinition {
  std::string name;  ///< "foot", "cycle"
  double radius_m, length_m, end_y_m, crown_z_m, rise_m;
  double chord_spacing_m, truss_depth_m, bottom_chord_offset_m, nonstructural_mass_kg_m;
  double bottom_chord_spacing_m;  ///< 0: one bottom chord; above: two, so far apart
  double slab_height_m;           ///< middle plane of the slab above the axes of the top chords
  bool stays_on_outer_edge;
  double bracket_arm_m;
  StayRow stay;
  std::vector<SlabZone> slab;                                                      ///< from mid-length outwards
  fe::Section top_chord, bottom_chord, short_diagonal, long_diagonal, floor_beam;  ///< scaled
  BearingDefinition bearing;
};

struct MastDefinition {
  Eigen::Vector3d base_m;
  double height_m, lean_rad, infill_z_m, head_mass_kg;
  fe::Section steel, infill;  ///< scaled
  std::vector<double> node_z_m;
};

/// End block, pier below it and ramp behind it, alike at both ends.
struct EndDefinition {
  std::string material;
  double block_gap_m;  ///< between the deck ends and the block
  double block_length_m, block_width_m, block_height_m;
  std::array<int, 3> block_elements;  ///< across, along, up
  int beams_per_span;                 ///< of a ramp, and of a pier
  double ramp_length_m, ramp_end_z_m;
  int ramp_spans;
  fe::Section rigid_connection, pier, ramp, ramp_pier;
};

struct GroundCables {
  std::string type;
  Eigen::Vector3d anchor_m;  ///< of the northern one
  double mast_z_m;
};

/// A point of a deck: a damper at the station nearest to s, an accelerometer at the nearest row of slab nodes.
struct DeckPoint {
  std::string name, deck;
  bool outer_edge;
  double s_m;
};

struct DamperDefinition {
  std::string type;  ///< "A": group damper_A
  double damping_N_s_m, stiffness_N_m;
  bool series;
  bool vertical;  ///< else radial
  std::vector<DeckPoint> units;
};

struct ParameterDefinition {
  std::string name;
  fe::Target target;
  std::vector<std::string> of;
  double bound;  ///< half width of the bounds over the initial value
};

struct BridgeDefinition {
  std::string title, source;
  double gravity_m_s2;
  MeshDefinition mesh;
  std::vector<fe::Material> materials;  ///< without the stays'
  std::vector<StayType> stay_types;
  std::vector<DeckDefinition> decks;
  MastDefinition mast;
  GroundCables ground_cables;
  std::optional<EndDefinition> ends;  ///< without: the decks' bearings stand on the ground
  int aerodynamic_nodes = 0;          ///< a deck
  double minimum_pull_N, ridge, site_weight;
  std::map<std::string, double> site_pull_N;  ///< by stay, mirror images included
  std::vector<DamperDefinition> dampers;
  std::vector<DeckPoint> monitoring_points;
  std::vector<ParameterDefinition> parameters;
};

class DefinitionFile;
/// Gives the keys that a file may leave out their values: `bottom_chord_spacing` and `slab_height` of each deck, both 0 m.
void offer_optional_keys(DefinitionFile& file);
/// Reads the definition as it stands after the overrides applied to `file`.
/// @throws InputError naming file, line and key for a missing or unknown key, a value out of range, an unknown name
[[nodiscard]] BridgeDefinition read_definition(DefinitionFile file);

}  // namespace twindeck::ponte
