#pragma once

#include "fe/beam.hpp"

/// What the stiffness, mass and geometric stiffness of a beam share: its frame, its releases and its shape functions.
///
/// Local axes: x from end 1 to end 2; z the component of `orientation` normal to x (orientation zero: global Z, or global X
/// when the beam is within 1e-6 rad of vertical); y = z × x. Inertia_y is bending in the local x-z plane.
///
/// Bending is written for the two transverse deflections together, w = (v, w) along local y and z, with the slope vector
/// ψ = (rz, -ry), so that ψ = dw/dx without shear. An unsymmetric section then needs no rotation to its principal axes:
///   D = E ∫ r rᵀ dA = E [[Iz, Iyz], [Iyz, Iy]],   r = (y, z),   energy = ½ ∫ κᵀ D κ dx,   κ = dψ/dx.
namespace twindeck::fe::beam {

using Matrix2x12 = Eigen::Matrix<double, 2, 12>;

/// Skew matrix S(a) with S(a) b = a × b.
[[nodiscard]] Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a);

/// Local end displacements from global nodal ones, (12 × 12): u_end = R (u_node + θ × offset), θ_end = R θ.
[[nodiscard]] Matrix12 end_displacements(const BeamGeometry& geometry);

/// Rows that pick deflections (v, w) and slopes (rz, -ry) of `end` (0, 1) from the local end displacements.
[[nodiscard]] Matrix2x12 deflection_of(int end);
[[nodiscard]] Matrix2x12 slope_of(int end);

/// Section tensors: ∫ r rᵀ dA [m⁴], and the shear parameter Φ = 12/L² D (G A_s)⁻¹ [-], zero where the shear area is 0.
[[nodiscard]] Eigen::Matrix2d area_moments(const BeamStiffnessProperties& properties);
[[nodiscard]] Eigen::Matrix2d shear_parameter(const BeamStiffnessProperties& properties, double length_m);

/// Stiffness in local axes at the ends, before releases (12 × 12).
[[nodiscard]] Matrix12 local_stiffness(const BeamStiffnessProperties& properties, double length_m);

/// Displacements at the ends when the released ones follow without force:  u = T u_kept,  K_condensed = Tᵀ K T.
/// A released displacement without stiffness of its own stays zero.
/// @param stiffness  local stiffness (12 × 12);  @param releases  bit i = local end displacement i carries no force
[[nodiscard]] Matrix12 release_transformation(const Matrix12& stiffness, std::uint16_t releases);

/// A spring of stiffness c between two displacements.
inline void add_spring(Matrix12& k, int a, int b, double c) {
  k(a, a) += c;
  k(b, b) += c;
  k(a, b) -= c;
  k(b, a) -= c;
}

/// Deflection and slope at ξ = x/L as (2 × 12) functions of the local end displacements, exact for end loads (static):
///   w(ξ) = (1-ξ) w₁ + ξ w₂ + L/2 (ξ-ξ²)(ψ₁-ψ₂) + L (ξ-3ξ²+2ξ³)(1+Φ)⁻¹ q,   q = (ψ₁+ψ₂)/2 - (w₂-w₁)/L,
/// which are the Hermite cubics when Φ = 0; ψ(ξ) = dw/dx - γ with the constant shear strain γ = ((1+Φ)⁻¹ - 1) q.
struct Shape {
  Matrix2x12 deflection, deflection_slope, section_slope;
};
[[nodiscard]] Shape shape_at(double xi, double length_m, const Eigen::Matrix2d& shear_parameter);

/// Gauss points on [0, 1] with four points: exact to degree 7 (the mass of cubics has degree 6).
struct GaussPoint {
  double xi, weight;
};
[[nodiscard]] std::array<GaussPoint, 4> gauss_points();

}  // namespace twindeck::fe::beam
