#pragma once

#include "ponte/bridge_definition.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

/// Nodes of the two ends that the decks' bearings lean on: the middle of the end blocks' front faces; -1: they stand on the
/// ground.
struct EndNodes {
  int north = -1, south = -1;
};
/// End blocks of solids, the pier below each and the ramp behind it; nothing if the definition has no ends.
[[nodiscard]] EndNodes build_ends(ModelBuilder& builder, const BridgeDefinition& definition);

}  // namespace twindeck::ponte
