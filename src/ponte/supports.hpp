#pragma once

#include "ponte/bridge_definition.hpp"
#include "ponte/deck.hpp"
#include "ponte/ends.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

/// Springs of both ends: groups foot_north, foot_south, cycle_north, cycle_south. With end blocks each bearing stands on a node
/// at its own place that moves with the block as a rigid body.
void build_deck_supports(ModelBuilder& builder, const DeckDefinition& deck, const DeckNodes& nodes, const EndNodes& ends);

}  // namespace twindeck::ponte
