#pragma once

#include "fe/shell_membrane.hpp"

/// What the membrane, bending and mass of the four-node shell share: the mean plane and the bilinear map on it.
namespace twindeck::fe::shell {

/// Mean plane of a quadrilateral: through the mean of its nodes, parallel to both diagonals, so that the nodes lie alternately
/// `+h` and `-h` off it. Local x joins the midpoints of the sides 4-1 and 2-3, z = x13 × x24 / |x13 × x24|.
struct Frame {
  Eigen::Matrix3d axes;                     ///< rows local x, y, z in global axes
  std::array<Eigen::Vector2d, 4> corner_m;  ///< projected nodes, origin at their mean
  std::array<double, 4> height_m;           ///< of the nodes above the plane
};
/// @throws InputError for a quadrilateral without area, or not convex
[[nodiscard]] Frame frame_of(const ShellGeometry& geometry);

/// Local displacements (x y z rx ry rz) of the projected corners from global nodal ones, (24 × 24). The distance between node
/// and plane is a rigid arm: u_corner = R (u_node + θ × (-h z)), so a warped element still moves freely as a rigid body.
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
