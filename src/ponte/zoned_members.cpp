#include "ponte/zoned_members.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/error.hpp"

namespace twindeck::ponte {

namespace {

constexpr double kBound = 0.5;  // of the parameters, relative

std::string deck_of(const std::string& group) {
  for (const std::string deck : {"foot", "cycle"}) {
    if (group.starts_with(deck + "_")) return deck;
  }
  return "";
}

/// From 1 at mid-length to `zones` at the ends, by x, which grows along the deck all the way.
int zone_of(double x_m, double reach_m, int zones) {
  return 1 + std::min(zones - 1, static_cast<int>(std::abs(x_m) / reach_m * zones));
}

void add_parameter(fe::Model& model, const std::string& name, fe::Target target, const std::string& of, const std::string& unit,
                   double value) {
  model.parameters.push_back({name, target, {of}, unit, value, value * (1.0 - kBound), value * (1.0 + kBound)});
}

}  // namespace

fe::Model with_zoned_members(fe::Model model, int zones) {
  TWINDECK_ASSERT(zones >= 1);
  const auto x_of = [&](int node) { return model.nodes[static_cast<std::size_t>(node)].x_m.x(); };
  std::map<std::string, double> reach_m;
  for (const fe::PointMass& mass : model.masses) {
    double& reach = reach_m[deck_of(mass.group)];
    reach = std::max(reach, std::abs(x_of(mass.node)));
  }
  std::map<std::string, int> material_of;
  for (fe::Element& element : model.elements) {
    const std::string deck = deck_of(element.group);
    if (element.type != fe::ElementType::beam || deck.empty()) continue;
    const double x = (x_of(element.nodes[0]) + x_of(element.nodes[1])) / 2.0;
    const std::string name = element.group + "_" + std::to_string(zone_of(x, reach_m.at(deck), zones));
    const auto [entry, is_new] = material_of.try_emplace(name, static_cast<int>(model.materials.size()));
    if (is_new) {
      fe::Material material = model.materials[static_cast<std::size_t>(element.material)];
      material.name = "steel_" + name;
      model.materials.push_back(material);
      add_parameter(model, "E_" + name, fe::Target::youngs_modulus, material.name, "Pa", material.youngs_modulus_Pa);
    }
    element.material = entry->second;
  }
  std::map<std::string, bool> seen;
  for (fe::PointMass& mass : model.masses) {
    const std::string deck = deck_of(mass.group);
    if (deck.empty()) continue;
    mass.group += "_" + std::to_string(zone_of(x_of(mass.node), reach_m.at(deck), zones));
    if (!seen.emplace(mass.group, true).second) continue;
    add_parameter(model, "m_" + mass.group, fe::Target::point_mass, mass.group, "-", 1.0);
  }
  return model;
}

}  // namespace twindeck::ponte
