#pragma once

#include <cstdint>
#include <vector>

#include "fe/model.hpp"

namespace twindeck::fe {

/// Sides of three-node shells that a four-node shell has too. A triangle's sides bend with the rotations of their ends, those
/// of a four-node shell stay straight; on a common side the triangle's has to stay straight as well, or the mesh would not pass
/// the patch test of constant membrane stress (triangle_membrane.hpp).
/// @return (n_elements) bit i set: the side from the element's node i to the next; 0 for all but triangles
[[nodiscard]] std::vector<std::uint8_t> sides_beside_four_nodes(const Model& model);

}  // namespace twindeck::fe
