#pragma once

#include <map>
#include <string>

#include "ponte/bridge_definition.hpp"
#include "ponte/deck.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

/// Dampers as inactive springs: groups damper_A, damper_B, damper_C.
void build_dampers(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks);

}  // namespace twindeck::ponte
