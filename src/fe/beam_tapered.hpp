#pragma once

#include "fe/elements.hpp"

/// Beam whose section varies between its ends, for sections of similar shape whose size varies linearly (truncated cones,
/// tapered tubes and boxes of constant proportions): with ξ = x/L
///   A(ξ) = ((1-ξ) √A₁ + ξ √A₂)²,   I(ξ) = ((1-ξ) ⁴√I₁ + ξ ⁴√I₂)⁴,
/// shear areas like A, the torsion constant like I, and Iyz = r √(Iy Iz) with r linear. Both ends have one material.
namespace twindeck::fe {

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
