#include "ponte/bridge_definition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lists.hpp"
#include "ponte/definition_file.hpp"

namespace twindeck::ponte {

namespace {

using Range = DefinitionFile::Range;
constexpr Range kCoordinate{-1e4, 1e4};    // [m]
constexpr Range kLength{1e-3, 1e4};        // [m]
constexpr Range kModulus{1e6, 1e13};       // [Pa]
constexpr Range kDensity{1.0, 1e5};        // [kg/m³]
constexpr Range kStiffness{0.0, 1e14};     // [N/m]
constexpr Range kFactor{1e-3, 1e3};        // [-]
constexpr Range kPull{1.0, 1e8};           // [N]
constexpr Range kMassPerLength{0.0, 1e5};  // [kg/m]

/// Material of the stiff members that connect a node with the face of a solid: fifty times as stiff as steel, no weight.
const fe::Material kRigid{"rigid", 1e13, 1e13 / 2.6, 0.3, 0.0};

fe::Section round_section(const std::string& name, double outer_m, double inner_m, double shear_factor) {
  fe::Section out{.name = name, .area_m2 = std::numbers::pi / 4 * (std::pow(outer_m, 2) - std::pow(inner_m, 2))};
  out.inertia_y_m4 = out.inertia_z_m4 = std::numbers::pi / 64 * (std::pow(outer_m, 4) - std::pow(inner_m, 4));
  out.torsion_m4 = 2 * out.inertia_y_m4;
  out.shear_area_y_m2 = out.shear_area_z_m2 = shear_factor * out.area_m2;
  return out;
}

/// @param size  what the message calls `size_m`
void check_wall(DefinitionFile& file, const std::string& path, const std::string& size, double size_m, double wall_m) {
  if (2 * wall_m >= size_m)
    file.fail(path + ".wall", fmt::format("is {:g} m, expected less than half the {} ({:g} m)", wall_m, size, size_m / 2),
              "correct the wall or the " + size);
}

/// Square hollow section of sharp corners: A = b² - (b-2t)², I = (b⁴ - (b-2t)⁴)/12, J = t (b-t)³ (Bredt), shear areas A/2 (two
/// of four walls).
fe::Section square_hollow_section(const std::string& name, double side_m, double wall_m) {
  const double inner = side_m - 2 * wall_m;
  fe::Section out{.name = name, .area_m2 = side_m * side_m - inner * inner};
  out.inertia_y_m4 = out.inertia_z_m4 = (std::pow(side_m, 4) - std::pow(inner, 4)) / 12;
  out.torsion_m4 = wall_m * std::pow(side_m - wall_m, 3);
  out.shear_area_y_m2 = out.shear_area_z_m2 = 0.5 * out.area_m2;
  return out;
}

/// A, I_y, I_z, J and the shear areas times a factor: an effective section, fitted.
fe::Section scaled(fe::Section section, double factor) {
  for (double* value : {&section.area_m2, &section.inertia_y_m4, &section.inertia_z_m4, &section.torsion_m4,
                        &section.shear_area_y_m2, &section.shear_area_z_m2})
    *value *= factor;
  return section;
}

/// Circular tube: A = pi/4 (D² - d²), I = pi/64 (D⁴ - d⁴), J = 2 I, shear areas A/2 (thin tube, Cowper 1966).
fe::Section tube_section(const std::string& name, double diameter_m, double wall_m) {
  return round_section(name, diameter_m, diameter_m - 2 * wall_m, 0.5);
}

/// Solid circle; shear areas 0.9 A.
fe::Section solid_circle_section(const std::string& name, double diameter_m) {
  return round_section(name, diameter_m, 0.0, 0.9);
}

/// Solid rectangle; `depth` along local z, `width` along local y; torsion b t³ (1/3 - 0.21 t/b (1 - t⁴/(12 b⁴))) for b >= t
/// (Roark), shear areas 5/6 A.
fe::Section rectangle_section(const std::string& name, double depth_m, double width_m) {
  const double b = std::max(depth_m, width_m), t = std::min(depth_m, width_m);
  fe::Section out{.name = name,
                  .area_m2 = depth_m * width_m,
                  .inertia_y_m4 = width_m * std::pow(depth_m, 3) / 12,
                  .inertia_z_m4 = depth_m * std::pow(width_m, 3) / 12,
                  .torsion_m4 = b * std::pow(t, 3) * (1.0 / 3 - 0.21 * t / b * (1 - std::pow(t / b, 4) / 12))};
  out.shear_area_y_m2 = out.shear_area_z_m2 = out.area_m2 * 5 / 6;
  return out;
}

/// The table `path` of bridge.toml: shape (tube | square_hollow | rolled) with its sizes, and scale.
/// @throws InputError for a size out of range, a wall of more than half the width
fe::Section read_member_section(DefinitionFile& file, const std::string& path, const std::string& name) {
  const std::string shape = file.choice(path + ".shape", {"tube", "square_hollow", "rolled"});
  const double scale = file.number(path + ".scale", "", {1e-3, 1e3});
  if (shape == "rolled") {
    fe::Section out{.name = name,
                    .area_m2 = file.number(path + ".area", "m2", {1e-6, 10.0}),
                    .inertia_y_m4 = file.number(path + ".inertia_y", "m4", {1e-12, 10.0}),
                    .inertia_z_m4 = file.number(path + ".inertia_z", "m4", {1e-12, 10.0}),
                    .torsion_m4 = file.number(path + ".torsion", "m4", {1e-12, 10.0}),
                    .shear_area_y_m2 = file.number(path + ".shear_area_y", "m2", {0.0, 10.0}),
                    .shear_area_z_m2 = file.number(path + ".shear_area_z", "m2", {0.0, 10.0})};
    return scaled(out, scale);
  }
  const double width = file.number(path + (shape == "tube" ? ".diameter" : ".side"), "m", {1e-3, 10.0});
  const double wall = file.number(path + ".wall", "m", {1e-4, 5.0});
  check_wall(file, path, "width", width, wall);
  return scaled(shape == "tube" ? tube_section(name, width, wall) : square_hollow_section(name, width, wall), scale);
}

fe::Material read_material(DefinitionFile& file, const std::string& name) {
  const std::string path = "material." + name;
  fe::Material out{.name = name,
                   .youngs_modulus_Pa = file.number(path + ".youngs_modulus", "Pa", kModulus),
                   .poisson_ratio = file.number(path + ".poisson_ratio", "", {0.0, 0.49})};
  out.shear_modulus_Pa = out.youngs_modulus_Pa / (2.0 * (1.0 + out.poisson_ratio));
  out.density_kg_m3 = file.number(path + ".density", "kg/m3", kDensity);
  return out;
}

StayType read_stay_type(DefinitionFile& file, const std::string& name) {
  const std::string path = "stay_type." + name;
  return {name, file.number(path + ".youngs_modulus", "Pa", kModulus), file.number(path + ".area", "m2", {1e-6, 1.0}),
          file.number(path + ".mass_per_length", "kg/m", {1e-3, 1e4})};
}

StayRow read_stay_row(DefinitionFile& file, const std::string& path, const std::vector<std::string>& types) {
  return StayRow{.count = file.integer(path + ".count", 2, 50),
                 .spacing_m = file.number(path + ".spacing", "m", kLength),
                 .last_spacing_m = file.number(path + ".last_spacing", "m", kLength),
                 .prefix_north = file.text(path + ".prefix_north"),
                 .prefix_south = file.text(path + ".prefix_south"),
                 .type = file.choice(path + ".type", types),
                 .last_type = file.choice(path + ".last_type", types),
                 .top_anchor_z_m = file.number(path + ".top_anchor_z", "m", kCoordinate),
                 .anchor_pitch_m = file.number(path + ".anchor_pitch", "m", kLength)};
}

std::vector<SlabZone> read_slab(DefinitionFile& file, const std::string& deck, const std::vector<std::string>& materials) {
  const std::string slab = "deck." + deck + ".slab";
  const std::vector<std::string> zones = file.texts(slab + ".zones");
  if (zones.empty()) file.fail(slab + ".zones", "has no zone", "name at least one");
  std::vector<SlabZone> out;
  double reached = 0.0;
  for (const std::string& zone : zones) {
    const std::string path = slab + "." + zone;
    SlabZone z;
    z.group = "slab_" + deck + (zones.size() == 1 ? "" : "_" + zone);
    z.until = file.number(path + ".until", "", {0.0, 1.0});
    if (z.until <= reached)
      file.fail(path + ".until", fmt::format("is {:g}, expected more than the zone before ({:g})", z.until, reached),
                "order the zones from mid-length outwards");
    reached = z.until;
    z.thickness_m = file.number(path + ".thickness", "m", {1e-3, 5.0});
    z.bending_inertia_ratio = file.number(path + ".bending_inertia_ratio", "", kFactor);
    z.material = file.choice(path + ".material", materials);
    out.push_back(z);
  }
  if (reached != 1.0)
    file.fail(slab + "." + zones.back() + ".until", fmt::format("is {:g}, expected 1 for the last zone", reached),
              "let the last zone reach the end of the deck");
  return out;
}

DeckDefinition read_deck(DefinitionFile& file, const std::string& name, const std::vector<std::string>& materials,
                         const std::vector<std::string>& stay_types) {
  const std::string path = "deck." + name;
  DeckDefinition out;
  out.name = name;
  out.radius_m = file.number(path + ".radius", "m", kLength);
  out.length_m = file.number(path + ".length", "m", kLength);
  if (out.length_m >= 3.0 * out.radius_m)
    file.fail(path + ".length",
              fmt::format("is {:g} m, expected less than three radii ({:g} m)", out.length_m, 3 * out.radius_m),
              "a deck that closes upon itself is no deck");
  out.end_y_m = file.number(path + ".end_y", "m", kCoordinate);
  out.crown_z_m = file.number(path + ".crown_z", "m", kCoordinate);
  out.rise_m = file.number(path + ".rise", "m", kCoordinate);
  out.chord_spacing_m = file.number(path + ".chord_spacing", "m", {0.1, 100.0});
  out.truss_depth_m = file.number(path + ".truss_depth", "m", {0.1, 100.0});
  out.bottom_chord_offset_m = file.number(path + ".bottom_chord_offset", "m", {-100.0, 100.0});
  out.bottom_chord_spacing_m = file.number(path + ".bottom_chord_spacing", "m", {0.0, 100.0});
  out.slab_height_m = file.number(path + ".slab_height", "m", {0.0, 10.0});
  out.nonstructural_mass_kg_m = file.number(path + ".nonstructural_mass", "kg/m", kMassPerLength);
  out.stays_on_outer_edge = file.choice(path + ".stay_edge", {"inner", "outer"}) == "outer";
  out.bracket_arm_m = file.number(path + ".bracket_arm", "m", {1e-3, 10.0});
  out.stay = read_stay_row(file, path + ".stay", stay_types);
  out.slab = read_slab(file, name, materials);
  out.top_chord = read_member_section(file, path + ".top_chord", name + "_top_chord");
  out.bottom_chord = read_member_section(file, path + ".bottom_chord", name + "_bottom_chord");
  out.short_diagonal = read_member_section(file, path + ".short_diagonal", name + "_short_diagonal");
  out.long_diagonal = read_member_section(file, path + ".long_diagonal", name + "_long_diagonal");
  out.floor_beam = read_member_section(file, path + ".floor_beam", name + "_floor_beam");
  out.bearing = {
      file.number(path + ".bearing.bottom", "N/m", kStiffness), file.number(path + ".bearing.vertical", "N/m", kStiffness),
      file.number(path + ".bearing.radial", "N/m", kStiffness), file.number(path + ".bearing.tangential", "N/m", kStiffness)};
  const double last_stay = (out.stay.count - 1.5) * out.stay.spacing_m + out.stay.last_spacing_m;
  if (last_stay >= out.length_m / 2)
    file.fail(path + ".stay.count",
              fmt::format("puts the last stay at {:g} m, beyond the deck's end at {:g} m", last_stay, out.length_m / 2),
              "reduce the number or the spacing of the stays");
  return out;
}

MastDefinition read_mast(DefinitionFile& file) {
  MastDefinition out;
  out.base_m = {file.number("mast.base_x", "m", kCoordinate), file.number("mast.base_y", "m", kCoordinate),
                file.number("mast.base_z", "m", kCoordinate)};
  out.height_m = file.number("mast.height", "m", {1.0, 1e3});
  out.lean_rad = file.number("mast.lean", "rad", {-1.0, 1.0});
  const double diameter = file.number("mast.outer_diameter", "m", {0.01, 100.0});
  const double wall = file.number("mast.wall", "m", {1e-3, 10.0});
  check_wall(file, "mast", "diameter", diameter, wall);
  const double steel_scale = file.number("mast.steel_scale", "", kFactor);
  out.steel = scaled(tube_section("mast_steel", diameter, wall), steel_scale);
  out.infill = scaled(solid_circle_section("mast_infill", diameter - 2 * wall), file.number("mast.infill_scale", "", kFactor));
  out.infill_z_m = file.number("mast.infill_z", "m", {out.base_m.z(), out.base_m.z() + out.height_m});
  out.head_mass_kg = steel_scale * file.number("mast.head_mass", "kg", {0.0, 1e6});
  out.node_z_m = file.numbers("mast.node_z", "m", {out.base_m.z(), out.base_m.z() + out.height_m});
  return out;
}

EndDefinition read_ends(DefinitionFile& file) {
  const Range size{0.05, 100.0};  // [m]
  const auto length = [&](const std::string& key) { return file.number("ends." + key, "m", size); };
  const auto count = [&](const std::string& key) { return file.integer("mesh." + key, 1, 40); };
  EndDefinition out;
  out.material = "concrete_ends";
  out.block_gap_m = length("block_gap");
  out.block_length_m = length("block_length");
  out.block_width_m = length("block_width");
  out.block_height_m = length("block_height");
  out.block_elements = {count("block_across"), count("block_along"), count("block_up")};
  out.beams_per_span = count("beams_per_span");
  out.ramp_length_m = file.number("ends.ramp_length", "m", {1.0, 1e3});
  out.ramp_end_z_m = length("ramp_end_z");
  out.ramp_spans = file.integer("ends.ramp_spans", 1, 100);
  // Walls stand with their width across; their local z lies along the ramp.
  out.pier = rectangle_section("pier", length("pier_thickness"), length("pier_width"));
  out.ramp = rectangle_section("ramp", length("ramp_depth"), length("ramp_width"));
  out.ramp_pier = rectangle_section("ramp_pier", length("ramp_pier_thickness"), length("ramp_pier_width"));
  out.rigid_connection = solid_circle_section("rigid_connection", 0.3);
  return out;
}

DeckPoint read_point(DefinitionFile& file, const std::string& path, const DeckDefinition& deck) {
  return {file.text(path + ".name"), deck.name, file.choice(path + ".edge", {"inner", "outer"}) == "outer",
          file.number(path + ".s", "m", {-deck.length_m / 2, deck.length_m / 2})};
}

const DeckDefinition& deck_of(DefinitionFile& file, const std::string& path, const std::vector<DeckDefinition>& decks) {
  const std::string name = file.choice(path, each_of(decks, &DeckDefinition::name));
  return *std::ranges::find(decks, name, &DeckDefinition::name);
}

DamperDefinition read_damper(DefinitionFile& file, const std::string& path, const std::vector<DeckDefinition>& decks) {
  DamperDefinition out;
  out.type = file.text(path + ".type");
  out.damping_N_s_m = file.number(path + ".damping", "N s/m", {0.0, 1e12});
  out.stiffness_N_m = file.number(path + ".stiffness", "N/m", kStiffness);
  out.series = file.choice(path + ".arrangement", {"series", "parallel", "viscous"}) == "series";
  out.vertical = file.choice(path + ".direction", {"vertical", "radial"}) == "vertical";
  const DeckDefinition& deck = deck_of(file, path + ".deck", decks);
  for (std::size_t i = 0; i < file.size(path + ".units"); ++i)
    out.units.push_back(read_point(file, path + ".units." + std::to_string(i), deck));
  return out;
}

ParameterDefinition read_parameter(DefinitionFile& file, const std::string& path) {
  const std::map<std::string, fe::Target> targets = {{"youngs_modulus", fe::Target::youngs_modulus},
                                                     {"density", fe::Target::density},
                                                     {"bending_inertia_ratio", fe::Target::bending_inertia_ratio},
                                                     {"thickness", fe::Target::thickness},
                                                     {"area", fe::Target::area},
                                                     {"spring_stiffness", fe::Target::spring_stiffness},
                                                     {"point_mass", fe::Target::point_mass}};
  const auto names = each_of(targets, [](const auto& target) { return target.first; });
  return {file.text(path + ".name"), targets.at(file.choice(path + ".target", names)), file.texts(path + ".of"),
          file.number(path + ".bound", "", {0.0, 0.99})};
}

/// Names of all stays: NE1 ... , SE1 ..., NW..., SW..., BN, BS.
std::vector<std::string> stay_names(const BridgeDefinition& definition) {
  std::vector<std::string> out;
  for (const DeckDefinition& deck : definition.decks)
    for (const std::string& prefix : {deck.stay.prefix_north, deck.stay.prefix_south})
      for (int i = 1; i <= deck.stay.count; ++i) out.push_back(prefix + std::to_string(i));
  out.push_back("BN");
  out.push_back("BS");
  return out;
}

void read_site_pulls(DefinitionFile& file, BridgeDefinition& out) {
  const std::vector<std::string> stays = stay_names(out);
  for (const std::string& name : file.names_below("site_pull")) {
    const std::string path = "site_pull." + name;
    if (!contains(stays, name))
      file.fail(path, "is no stay of this bridge" + did_you_mean(name, stays), "name a stay such as NE5");
    const double pull = file.number(path, "N", kPull);
    out.site_pull_N[name] = pull;
    // The bridge is symmetric about mid-length: N… and S… are mirror images, BN and BS too.
    std::string mirror = name;
    char& side = mirror[name.front() == 'B' ? 1 : 0];
    side = side == 'N' ? 'S' : 'N';
    out.site_pull_N.emplace(mirror, pull);
  }
}

}  // namespace

void offer_optional_keys(DefinitionFile& file) {
  for (const std::string deck : {"foot", "cycle"})
    for (const std::string key : {"bottom_chord_spacing", "slab_height"}) file.offer_number("deck." + deck + "." + key, 0.0);
}

BridgeDefinition read_definition(DefinitionFile file) {
  offer_optional_keys(file);
  BridgeDefinition out;
  out.source = file.name();
  out.title = file.text("title");
  out.gravity_m_s2 = file.number("gravity", "m/s^2", {0.0, 100.0});
  out.mesh = {file.integer("mesh.panels_per_stay_spacing", 1, 40), file.integer("mesh.shells_across", 2, 40),
              file.integer("mesh.shells_per_panel_along", 1, 20), file.integer("mesh.members_per_panel", 1, 20)};
  const std::vector<std::string> materials = {"concrete_normal", "concrete_light", "steel"};
  for (const std::string& name : materials) out.materials.push_back(read_material(file, name));
  const std::vector<std::string> stay_types = file.names_below("stay_type");
  for (const std::string& name : stay_types) out.stay_types.push_back(read_stay_type(file, name));
  for (const std::string name : {"foot", "cycle"}) out.decks.push_back(read_deck(file, name, materials, stay_types));
  out.mast = read_mast(file);
  out.ground_cables = {file.choice("ground_cable.type", stay_types),
                       {file.number("ground_cable.x", "m", kCoordinate), file.number("ground_cable.y", "m", kCoordinate),
                        file.number("ground_cable.z", "m", kCoordinate)},
                       file.number("ground_cable.mast_z", "m", kCoordinate)};
  if (file.has("ends")) {
    out.materials.push_back(read_material(file, "concrete_ends"));
    out.materials.push_back(kRigid);
    out.ends = read_ends(file);
  }
  if (file.has("aerodynamics")) out.aerodynamic_nodes = file.integer("aerodynamics.nodes_per_deck", 2, 1000);
  out.minimum_pull_N = file.number("prestress.minimum_pull", "N", {0.0, 1e8});
  out.ridge = file.number("prestress.ridge", "", {0.0, 1e3});
  out.site_weight = file.number("prestress.site_weight", "", {0.0, 1e3});
  read_site_pulls(file, out);
  for (std::size_t i = 0; i < file.size("damper"); ++i)
    out.dampers.push_back(read_damper(file, "damper." + std::to_string(i), out.decks));
  for (std::size_t i = 0; i < file.size("monitoring_point"); ++i) {
    const std::string path = "monitoring_point." + std::to_string(i);
    out.monitoring_points.push_back(read_point(file, path, deck_of(file, path + ".deck", out.decks)));
  }
  for (std::size_t i = 0; i < file.size("parameter"); ++i)
    out.parameters.push_back(read_parameter(file, "parameter." + std::to_string(i)));
  file.refuse_unknown();
  return out;
}

}  // namespace twindeck::ponte
