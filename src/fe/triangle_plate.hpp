#pragma once

#include "fe/triangle_corners.hpp"

namespace twindeck::fe::triangle {

/// Discrete-Kirchhoff plate bending of a triangle (DKT). Rotations of the normal are quadratic in the triangle. At the middle
/// of each side the part across the side is the mean of the corners' and the part along it is the slope of the side's cubic, so
/// that shear strains vanish along the sides and a thin plate does not lock. The triangle shares the cubics of its sides with
/// the four-node plate (DKQ), so that meshes of both fit together.
///
/// Reference: Batoz, Bathe and Ho (1980), A study of three-node triangular plate bending elements, IJNME 15, 1771-1812.
/// @param poisson_ratio  [-]
/// @return for unit E t³, (9 × 9): w, rx = dw/dy, ry = -dw/dx of corner 1, 2, 3; rank 6
[[nodiscard]] Matrix9 kirchhoff_plate(const Corners& corner_m, double poisson_ratio);

}  // namespace twindeck::fe::triangle
