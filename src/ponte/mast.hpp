#pragma once

#include <map>
#include <string>

#include "ponte/bridge_definition.hpp"
#include "ponte/deck.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

/// Mast: node by height, built in steel and concrete; base fixed, mass at the head.
struct MastNodes {
  std::map<double, int> by_z;
  [[nodiscard]] int at(double z_m) const;  ///< the node at this height, which must be there
  [[nodiscard]] int top() const { return by_z.rbegin()->second; }
};
[[nodiscard]] MastNodes build_mast(ModelBuilder& builder, const BridgeDefinition& definition);

/// Deck stays and the two ground cables, one element each.
void build_stays(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks,
                 const MastNodes& mast);

}  // namespace twindeck::ponte
