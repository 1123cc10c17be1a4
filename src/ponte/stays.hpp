#pragma once

#include <map>
#include <string>

#include "ponte/bridge_definition.hpp"
#include "ponte/deck.hpp"
#include "ponte/mast.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

/// Deck stays and the two ground cables, one element each.
void build_stays(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks,
                 const MastNodes& mast);

}  // namespace twindeck::ponte
