#include "ponte/dampers.hpp"

#include "ponte/deck_axis.hpp"

namespace twindeck::ponte {

void build_dampers(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks) {
  for (const DamperDefinition& damper : definition.dampers) {
    for (const DeckPoint& unit : damper.units) {
      const DeckNodes::Line& line = decks.at(unit.deck).station_near(unit.s_m);
      fe::Spring spring;
      spring.name = unit.name;
      spring.group = "damper_" + damper.type;
      spring.node = unit.outer_edge ? line.across.back() : line.across.front();
      for (const DeckDefinition& deck : definition.decks) {
        if (deck.name == unit.deck && !damper.vertical) {
          spring.direction = DeckAxis(deck).radial(line.s_m);
        }
      }
      spring.stiffness = damper.stiffness_N_m;
      spring.damping = damper.damping_N_s_m;
      spring.series = damper.series;
      spring.active = false;
      builder.model.springs.push_back(spring);
    }
  }
}

}  // namespace twindeck::ponte
