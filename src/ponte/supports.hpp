#pragma once

#include <map>
#include <string>

#include "ponte/bridge_definition.hpp"
#include "ponte/deck.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

/// Node at each end of the bridge that carries the decks' bearings: the middle of the end block's front face. -1: the bearings
/// stand on the ground.
struct EndNodes {
  int north = -1, south = -1;
};
/// End blocks of solids, the pier below each and the ramp behind it; nothing if the definition has no ends.
[[nodiscard]] EndNodes build_ends(ModelBuilder& builder, const BridgeDefinition& definition);

/// Springs of both ends: groups foot_north, foot_south, cycle_north, cycle_south. With end blocks each bearing stands on a node
/// at its own place that moves with the block as a rigid body.
void build_deck_supports(ModelBuilder& builder, const DeckDefinition& deck, const DeckNodes& nodes, const EndNodes& ends);

/// Dampers as inactive springs: groups damper_A, damper_B, damper_C.
void build_dampers(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks);

}  // namespace twindeck::ponte
