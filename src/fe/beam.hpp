#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "fe/element_matrices.hpp"

namespace twindeck::fe {

/// Two-node 3D beam. Local x from end 1 to end 2; local z the component of `orientation` normal to x (orientation zero: global
/// Z, or global X when the beam is within 1e-6 rad of vertical); local y = z × x. Bit i of `releases` frees local end
/// displacement i (0-5 = x y z rx ry rz of end 1, 6-11 of end 2).
struct BeamGeometry {
  std::array<Eigen::Vector3d, 2> node_m;
  std::array<Eigen::Vector3d, 2> offset_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  ///< node -> end, global axes
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();
  std::uint16_t releases = 0;
};
struct BeamStiffnessProperties {
  double youngs_modulus_Pa, shear_modulus_Pa, area_m2, inertia_y_m4, inertia_z_m4, inertia_yz_m4, torsion_m4, shear_area_y_m2,
      shear_area_z_m2;  ///< shear area 0 = rigid in shear
};
/// Rows: local x, y, z in global axes (3 × 3, orthonormal).
/// @throws InputError for a beam without length, or an orientation along its axis
[[nodiscard]] Eigen::Matrix3d beam_axes(const BeamGeometry& geometry);
[[nodiscard]] double beam_length(const BeamGeometry& geometry);
/// Timoshenko beam, exact for end loads (Przemieniecki 1968, section 5.6); releases condensed out, end offsets rigid. With
/// inertia_yz = ∫ y z dA the two bending planes couple; no principal axes are needed. Shear areas belong to local y and z.
[[nodiscard]] Matrix12 beam_stiffness(const BeamGeometry& geometry, const BeamStiffnessProperties& properties);
/// Axial force (tension positive) at mid-length from end displacements in global axes.
[[nodiscard]] double beam_axial_force(const BeamGeometry& geometry, const BeamStiffnessProperties& properties,
                                      const Vector12& u);

/// Consistent mass on the shapes of the stiffness (Przemieniecki 1968, section 11.4; cubics for an Euler beam), SI.
/// `rotary_inertia` adds ρ ∫ ψᵀ I ψ dx of the section's tilt; the polar inertia ρ (Iy + Iz) of twist is always included.
[[nodiscard]] Matrix12 beam_mass(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, double density_kg_m3,
                                 bool rotary_inertia);
/// Half of the mass at each end, and half of the section's rotary inertia (about its axis always, across it if asked for).
[[nodiscard]] Matrix12 beam_mass_lumped(const BeamGeometry& geometry, const BeamStiffnessProperties& properties,
                                        double density_kg_m3, bool rotary_inertia);

/// Geometric stiffness of an axial force N (tension positive), N ∫ w'ᵀ w' dx with cubic shape functions (no Wagner twist term).
[[nodiscard]] Matrix12 beam_geometric_stiffness(const BeamGeometry& geometry, double axial_force_N);

// Beam whose section varies between its ends, for sections of similar shape whose size varies linearly (truncated cones,
// tapered tubes and boxes of constant proportions): with ξ = x/L
//   A(ξ) = ((1-ξ) √A₁ + ξ √A₂)²,   I(ξ) = ((1-ξ) ⁴√I₁ + ξ ⁴√I₂)⁴,
// shear areas like A, the torsion constant like I, and Iyz = r √(Iy Iz) with r linear. Both ends have one material.

struct TaperedProperties {
  BeamStiffnessProperties end1, end2;
};

/// Exact for end loads: the flexibility of the cantilever is integrated along the beam (eight Gauss points; relative error
/// below 1e-8 for ends whose sizes differ twofold) and inverted, so nothing is assumed of the deflected shape. Releases and
/// offsets as for the uniform beam, which is returned when both ends are equal. Reference: Przemieniecki (1968), Theory of
/// Matrix Structural Analysis, section 6.4 (stiffness from flexibility).
[[nodiscard]] Matrix12 tapered_beam_stiffness(const BeamGeometry& geometry, const TaperedProperties& properties);
/// Consistent mass on the shapes of a uniform beam with the section of mid-length.
[[nodiscard]] Matrix12 tapered_beam_mass(const BeamGeometry& geometry, const TaperedProperties& properties,
                                         double density_kg_m3, bool rotary_inertia);
/// Mass ρ ∫ A (1-ξ) dx at the first end, ρ ∫ A ξ dx at the second; rotary inertia likewise.
[[nodiscard]] Matrix12 tapered_beam_mass_lumped(const BeamGeometry& geometry, const TaperedProperties& properties,
                                                double density_kg_m3, bool rotary_inertia);
/// Axial force (tension positive) from end displacements in global axes.
[[nodiscard]] double tapered_beam_axial_force(const BeamGeometry& geometry, const TaperedProperties& properties,
                                              const Vector12& u);

}  // namespace twindeck::fe
