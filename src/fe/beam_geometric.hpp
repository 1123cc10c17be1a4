#pragma once

#include "fe/beam.hpp"
#include "fe/element_matrices.hpp"

namespace twindeck::fe {

/// Geometric stiffness of an axial force N (tension positive), N ∫ w'ᵀ w' dx with cubic shape functions (no Wagner twist term).
[[nodiscard]] Matrix12 beam_geometric_stiffness(const BeamGeometry& geometry, double axial_force_N);

}  // namespace twindeck::fe
