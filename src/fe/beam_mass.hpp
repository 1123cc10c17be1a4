#pragma once

#include "fe/beam.hpp"
#include "fe/element_matrices.hpp"

namespace twindeck::fe {

/// Consistent mass on the shapes of the stiffness (Przemieniecki 1968, section 11.4; cubics for an Euler beam), SI.
/// `rotary_inertia` adds ρ ∫ ψᵀ I ψ dx of the section's tilt; the polar inertia ρ (Iy + Iz) of twist is always included.
[[nodiscard]] Matrix12 beam_mass(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, double density_kg_m3,
                                 bool rotary_inertia);
/// Half of the mass at each end, and half of the section's rotary inertia (about its axis always, across it if asked for).
[[nodiscard]] Matrix12 beam_mass_lumped(const BeamGeometry& geometry, const BeamStiffnessProperties& properties,
                                        double density_kg_m3, bool rotary_inertia);

}  // namespace twindeck::fe
