#pragma once

#include <cstdint>

#include "fe/triangle_corners.hpp"

namespace twindeck::fe::triangle {

/// Membrane of a triangle with a rotation at each corner: the optimal one of the ANDES family ("OPT").
///
///     K = L D Lᵀ / A  +  ¾ β₀ A · T' (Σ Qᵀ E_n Q over the middles of the sides) T
///
/// The first part carries constant stresses and alone decides the patch test. The second is of the deviation of the corner
/// rotations from the mean rotation of the triangle (T), by assumed strains along the three sides (Q). It carries in-plane
/// bending and is the drilling stiffness; no penalty is added. Its ten coefficients are Felippa's optimal ones, with which two
/// triangles that make a rectangle have the exact energy of pure in-plane bending, whatever the sides' ratio. The triangle of
/// constant strain has 3 times that energy and more; Allman's triangle needs a stabilisation against a mechanism of equal
/// rotations. β₀ = ½ (1 - 4 ν²), at least 0.01.
///
/// Sides. The rotations of two corners bend the side between them (α = 3/2). A four-node shell's sides stay straight, so the
/// moments of constant stress would not balance along a common side. A side named in `straight_sides` therefore has α = 0: the
/// patch test then holds in meshes of both, side by side.
///
/// Reference: Felippa (2003), A study of optimal membrane triangles with drilling freedoms, CMAME 192, 2125-2168 (section 4 and
/// its coefficients of OPT); Alvin, de la Fuente, Haugen and Felippa (1992) for the part of constant stress.
/// @param poisson_ratio  [-], in [0, 0.5[
/// @param straight_sides  bit i set: side from corner i to the next (mixed_sides.hpp)
/// @return for unit E and thickness, (9 × 9): u, v, rz of corner 1, 2, 3; rank 6
[[nodiscard]] Matrix9 optimal_membrane(const Corners& corner_m, double poisson_ratio, std::uint8_t straight_sides);

/// Mean strains xx, yy, 2xy of the triangle from the nine displacements (3 × 9), those of its constant stresses.
[[nodiscard]] Eigen::Matrix<double, 3, 9> mean_strain(const Corners& corner_m, std::uint8_t straight_sides);

}  // namespace twindeck::fe::triangle
