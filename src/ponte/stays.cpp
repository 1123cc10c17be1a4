#include "ponte/stays.hpp"

namespace twindeck::ponte {

namespace {

void add_stay(ModelBuilder& builder, const std::string& name, const std::string& type, int lower, int mast) {
  builder.add_element(fe::ElementType::stay, "stay_" + type, "stay_steel_" + type, {lower, mast});
  builder.model.elements.back().name = name;
}

}  // namespace

void build_stays(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks,
                 const MastNodes& mast) {
  for (const StayType& type : definition.stay_types) {
    fe::Material material;
    material.name = "stay_steel_" + type.name;
    material.youngs_modulus_Pa = type.youngs_modulus_Pa;
    material.poisson_ratio = 0.3;  // no part in a bar; completes the data
    material.shear_modulus_Pa = type.youngs_modulus_Pa / 2.6;
    material.density_kg_m3 = type.mass_per_length_kg_m / type.area_m2;
    builder.add_material(material);
    fe::Section section;
    section.name = "stay_" + type.name;
    section.area_m2 = type.area_m2;
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
