#include "ponte/mast.hpp"

#include <cmath>
#include <set>

#include "core/error.hpp"

namespace twindeck::ponte {

namespace {

constexpr double kSameHeight_m = 1e-6;

// Heights at which the mast has a node.
std::set<double> heights(const BridgeDefinition& definition) {
  const MastDefinition& mast = definition.mast;
  std::set<double> wanted(mast.node_z_m.begin(), mast.node_z_m.end());
  wanted.insert({mast.base_m.z(), mast.base_m.z() + mast.height_m, mast.infill_z_m, definition.ground_cables.mast_z_m});
  for (const DeckDefinition& deck : definition.decks)
    for (int i = 0; i < deck.stay.count; ++i) wanted.insert(deck.stay.top_anchor_z_m - i * deck.stay.anchor_pitch_m);
  std::set<double> out;
  for (const double z : wanted)
    if (out.empty() || z - *out.rbegin() > kSameHeight_m) out.insert(z);
  return out;
}

void add_stay(ModelBuilder& builder, const std::string& name, const std::string& type, int lower, int mast) {
  builder.add_element(fe::ElementType::stay, "stay_" + type, "stay_steel_" + type, {lower, mast});
  builder.model.elements.back().name = name;
}

}  // namespace

int MastNodes::at(double z_m) const {
  const auto above = by_z.lower_bound(z_m - kSameHeight_m);
  TWINDECK_ASSERT(above != by_z.end() && std::abs(above->first - z_m) <= 2 * kSameHeight_m);
  return above->second;
}

MastNodes build_mast(ModelBuilder& builder, const BridgeDefinition& definition) {
  const MastDefinition& mast = definition.mast;
  builder.add_section(mast.steel);
  builder.add_section(mast.infill);
  MastNodes out;
  for (const double z : heights(definition)) {
    const double up = z - mast.base_m.z();
    if (up < 0.0 || up > mast.height_m + kSameHeight_m)
      throw InputError({definition.source, 0, "deck.*.stay.top_anchor_z"},
                       "puts a stay anchor at z = " + std::to_string(z) + " m, outside the mast",
                       "check top_anchor_z, anchor_pitch, ground_cable.mast_z and mast.height");
    out.by_z[z] = builder.add_node(mast.base_m + Eigen::Vector3d(0.0, up * std::tan(mast.lean_rad), up));
  }
  for (auto below = out.by_z.begin(), above = std::next(below); above != out.by_z.end(); ++below, ++above) {
    const std::vector<int> nodes = {below->second, above->second};
    builder.add_element(fe::ElementType::beam, "mast_steel", "steel", nodes, Eigen::Vector3d::UnitX());
    if (above->first <= mast.infill_z_m + kSameHeight_m)
      builder.add_element(fe::ElementType::beam, "mast_infill", "concrete_normal", nodes, Eigen::Vector3d::UnitX());
  }
  builder.model.masses.push_back({.group = "mast_head_mass", .node = out.top(), .mass_kg = mast.head_mass_kg});
  builder.model.supports.push_back({"mast", out.by_z.begin()->second, {true, true, true, true, true, true}});
  return out;
}

void build_stays(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks,
                 const MastNodes& mast) {
  for (const StayType& type : definition.stay_types) {
    fe::Material material{.name = "stay_steel_" + type.name, .youngs_modulus_Pa = type.youngs_modulus_Pa};
    material.poisson_ratio = 0.3;  // no part in a bar; completes the data
    material.shear_modulus_Pa = type.youngs_modulus_Pa / 2.6;
    material.density_kg_m3 = type.mass_per_length_kg_m / type.area_m2;
    builder.add_material(material);
    fe::Section section{.name = "stay_" + type.name, .area_m2 = type.area_m2};
    builder.add_section(section);
  }
  for (const DeckDefinition& deck : definition.decks) {
    const StayRow& row = deck.stay;
    for (const std::string& prefix : {row.prefix_north, row.prefix_south}) {
      for (int i = 1; i <= row.count; ++i) {
        const std::string name = prefix + std::to_string(i);
        const double z = row.top_anchor_z_m - (row.count - i) * row.anchor_pitch_m;
        add_stay(builder, name, i == row.count ? row.last_type : row.type, decks.at(deck.name).anchors.at(name), mast.at(z));
      }
    }
  }
  for (const bool north : {true, false}) {
    Eigen::Vector3d anchor = definition.ground_cables.anchor_m;
    anchor.x() *= north ? 1.0 : -1.0;
    const int ground = builder.add_node(anchor);
    builder.model.supports.push_back({north ? "ground_north" : "ground_south", ground, {true, true, true, true, true, true}});
    add_stay(builder, north ? "BN" : "BS", definition.ground_cables.type, ground, mast.at(definition.ground_cables.mast_z_m));
  }
}

}  // namespace twindeck::ponte
