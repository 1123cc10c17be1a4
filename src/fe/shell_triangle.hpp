#pragma once

#include "fe/shell_quad.hpp"

namespace twindeck::fe {

using Matrix18 = Eigen::Matrix<double, 18, 18>;

/// Flat three-node shell, the triangle beside the four-node shell of shell_quad.hpp: membrane with drilling rotations
/// (triangle.hpp), discrete-Mindlin plate bending, discrete-Kirchhoff where rigid in shear, mass on linear shapes. Nodes
/// anticlockwise seen from the normal x12 × x13. Matrices are in global axes, x y z rx ry rz of node 1, 2, 3, (18 × 18).
struct TriangleGeometry {
  std::array<Eigen::Vector3d, 3> node_m;
  std::uint8_t straight_sides =
      0;  ///< bit i set: the side from node i to the next is a four-node shell's too (sides_beside_four_nodes)
};

/// Membrane part, linear in E t. The drilling stiffness is the element's own: the DrillingRule of the four-node shell and its
/// factor have no part in it. A rigid turn in the plane stores no energy, and a constant strain turns all corners alike. With
/// `straight_sides` set the triangle passes the patch test beside four-node shells of either rule.
/// @throws InputError (all functions here) for a triangle without area
[[nodiscard]] Matrix18 triangle_membrane_stiffness(const TriangleGeometry& geometry, const ShellProperties& properties);
/// Bending part with transverse shear, as shell_bending_stiffness.
[[nodiscard]] Matrix18 triangle_bending_stiffness(const TriangleGeometry& geometry, const ShellProperties& properties);
/// Geometric stiffness of the triangle's mean membrane forces on linear shapes, as shell_geometric_stiffness.
/// @param displacement  (18) that strains the element, global axes
[[nodiscard]] Matrix18 triangle_geometric_stiffness(const TriangleGeometry& geometry, const ShellProperties& properties,
                                                    const Eigen::Ref<const Eigen::VectorXd>& displacement);
/// Consistent mass, treated as the four-node shell's: linear translations with `mass_per_area` [kg/m²], and `rotary_per_area`
/// [kg] (rho t³/12) on the bending rotations; drilling carries none.
[[nodiscard]] Matrix18 triangle_mass(const TriangleGeometry& geometry, double mass_per_area, double rotary_per_area);
/// Row sums of the same on the diagonal of each corner: a third of the element's at each.
[[nodiscard]] Matrix18 triangle_mass_lumped(const TriangleGeometry& geometry, double mass_per_area, double rotary_per_area);

}  // namespace twindeck::fe
