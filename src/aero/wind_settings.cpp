#include "aero/wind_settings.hpp"

#include <cmath>
#include <numbers>

#include "core/lists.hpp"

namespace twindeck::aero {

Wind WindSettings::wind() const {
  const double angle = direction_deg * std::numbers::pi / 180.0;
  return {density_kg_m3, {std::cos(angle), std::sin(angle), 0.0}};
}

std::vector<std::string> WindSettings::deck_names() const { return each_of(decks, &DeckWind::name); }

std::vector<Deployment> WindSettings::deployments() const {
  std::vector<Deployment> list;
  for (const std::string& name : models)
    list.push_back(aero::everywhere(name == oblique_rule ? aero::oblique_rule_H() : aero::published_yaw_rule(name)));
  if (!hybrid.empty()) {
    Deployment mixed = aero::everywhere(aero::published_yaw_rule(hybrid_inner));
    mixed.name = "hybrid";
    for (const HybridZone& zone : hybrid)
      mixed.zones.push_back({zone.deck, zone.beyond_deg * std::numbers::pi / 180.0, aero::published_yaw_rule(hybrid_outer)});
    list.push_back(mixed);
  }
  return list;
}

}  // namespace twindeck::aero
