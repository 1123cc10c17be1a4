#pragma once

#include "fe/shell_membrane.hpp"

/// The mean plane of the four-node shell and the bilinear map on this plane. The membrane, bending and mass matrices all use
/// them.
namespace twindeck::fe::shell {

/// Mean plane of a quadrilateral. It contains the mean of the nodes and is parallel to both diagonals. The distances of the
/// nodes from it are therefore `+h` and `-h` in turn. Local x goes from the midpoint of side 4-1 to the midpoint of side 2-3.
/// Local z is x13 × x24 / |x13 × x24|.
struct Frame {
  Eigen::Matrix3d axes;                     ///< rows local x, y, z in global axes
  std::array<Eigen::Vector2d, 4> corner_m;  ///< projected nodes, origin at their mean
  std::array<double, 4> height_m;           ///< signed distances of the nodes from the plane, along local z
};
/// @throws InputError for a quadrilateral that has no area or is not convex
[[nodiscard]] Frame frame_of(const ShellGeometry& geometry);

/// Transformation of global nodal displacements to local displacements (x y z rx ry rz) of the projected corners, (24 × 24). A
/// rigid link joins each node to its projected corner: u_corner = R (u_node + θ × (-h z)). A warped element can therefore move
/// as a rigid body without forces.
[[nodiscard]] Matrix24 corner_displacements(const Frame& frame);

/// Bilinear map at (ξ, η) ∈ [-1, 1]²; `jacobian` rows are d(x, y)/dξ and d(x, y)/dη.
struct Bilinear {
  Eigen::Vector4d value;
  Eigen::Matrix<double, 2, 4> gradient;  ///< d/dx, d/dy of the four functions [1/m]
  Eigen::Matrix2d jacobian, inverse;
  double determinant;
};
[[nodiscard]] Bilinear bilinear_at(const Frame& frame, double xi, double eta);

/// The 2 × 2 Gauss points (all weights 1).
[[nodiscard]] const std::array<Eigen::Vector2d, 4>& gauss_2x2();

/// Plane-stress matrix for unit E and thickness: stresses (xx, yy, xy) from strains (xx, yy, 2xy).
[[nodiscard]] Eigen::Matrix3d plane_stress(double poisson_ratio);

/// Signs of the corners: (ξ_i, η_i) = (-1,-1), (1,-1), (1,1), (-1,1).
inline constexpr std::array<double, 4> kXi = {-1.0, 1.0, 1.0, -1.0};
inline constexpr std::array<double, 4> kEta = {-1.0, -1.0, 1.0, 1.0};

}  // namespace twindeck::fe::shell
