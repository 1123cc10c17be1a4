#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

/// What membrane, plate and mass of the three-node shell share: its corners in its own plane and the gradients of linear
/// shapes.
namespace twindeck::fe::triangle {

using Corners = std::array<Eigen::Vector2d, 3>;  ///< [m], anticlockwise
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Area, positive for anticlockwise corners [m²].
[[nodiscard]] inline double area(const Corners& x) {
  const Eigen::Vector2d a = x[1] - x[0], b = x[2] - x[0];
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

/// d/dx, d/dy of the three area coordinates, one column each [1/m], (2 × 3).
[[nodiscard]] inline Eigen::Matrix<double, 2, 3> gradients(const Corners& x) {
  Eigen::Matrix<double, 2, 3> g;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d opposite = x[(i + 2) % 3] - x[(i + 1) % 3];
    g.col(static_cast<Eigen::Index>(i)) << -opposite.y(), opposite.x();
  }
  return g / (2.0 * area(x));
}

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
/// @param straight_sides  bit i set: side from corner i to the next (sides_beside_four_nodes)
/// @return for unit E and thickness, (9 × 9): u, v, rz of corner 1, 2, 3; rank 6
[[nodiscard]] Matrix9 optimal_membrane(const Corners& corner_m, double poisson_ratio, std::uint8_t straight_sides);

/// Mean strains xx, yy, 2xy of the triangle from the nine displacements (3 × 9), those of its constant stresses.
[[nodiscard]] Eigen::Matrix<double, 3, 9> mean_strain(const Corners& corner_m, std::uint8_t straight_sides);

/// Plate bending of a triangle (DKMT; DKT where the plate is rigid in shear). Rotations of the normal are quadratic in the
/// triangle. Shear strains are linear, and tangential ones constant along each side. Its sides are those of the four-node plate
/// (shell::plate_sides), so that a thin plate does not lock and meshes of both fit together.
///
/// Reference: Katili (1993), IJNME 36, 1859-1883 (DKMT); Batoz, Bathe and Ho (1980), A study of three-node triangular plate
/// bending elements, IJNME 15, 1771-1812 (DKT).
/// @param poisson_ratio  [-]
/// @param shear_length2_m2  ShellProperties::shear_length2_m2, 0: rigid in shear
/// @return for unit E t³, (9 × 9): w, rx, ry of corner 1, 2, 3; rank 6
[[nodiscard]] Matrix9 plate_bending(const Corners& corner_m, double poisson_ratio, double shear_length2_m2 = 0.0);

}  // namespace twindeck::fe::triangle
