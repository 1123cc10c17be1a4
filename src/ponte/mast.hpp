#pragma once

#include <map>

#include "ponte/bridge_definition.hpp"
#include "ponte/model_builder.hpp"

namespace twindeck::ponte {

/// Mast: node by height, built in steel and concrete; base fixed, mass at the head.
struct MastNodes {
  std::map<double, int> by_z;
  [[nodiscard]] int at(double z_m) const;  ///< the node at this height, which must be there
  [[nodiscard]] int top() const { return by_z.rbegin()->second; }
};
[[nodiscard]] MastNodes build_mast(ModelBuilder& builder, const BridgeDefinition& definition);

}  // namespace twindeck::ponte
