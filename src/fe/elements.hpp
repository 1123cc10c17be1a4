#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

/// Element matrices as pure functions: geometry and properties in, matrices in global axes out (order x y z rx ry rz per node).
namespace twindeck::fe {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

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
/// Consistent mass on the shapes of the stiffness (Przemieniecki 1968, section 11.4; cubics for an Euler beam), SI.
/// `rotary_inertia` adds ρ ∫ ψᵀ I ψ dx of the section's tilt; the polar inertia ρ (Iy + Iz) of twist is always included.
[[nodiscard]] Matrix12 beam_mass(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, double density_kg_m3,
                                 bool rotary_inertia);
/// Half of the mass at each end, and half of the section's rotary inertia (about its axis always, across it if asked for).
[[nodiscard]] Matrix12 beam_mass_lumped(const BeamGeometry& geometry, const BeamStiffnessProperties& properties,
                                        double density_kg_m3, bool rotary_inertia);
/// Geometric stiffness of an axial force N (tension positive), N ∫ w'ᵀ w' dx with cubic shape functions (no Wagner twist term).
[[nodiscard]] Matrix12 beam_geometric_stiffness(const BeamGeometry& geometry, double axial_force_N);
/// Axial force (tension positive) at mid-length from end displacements in global axes.
[[nodiscard]] double beam_axial_force(const BeamGeometry& geometry, const BeamStiffnessProperties& properties,
                                      const Vector12& u);

/// Bar or stay: axial stiffness EA/L along the chord; string stiffness T/L across it; mass. Translations of two nodes.
/// @throws InputError for a bar without length
[[nodiscard]] Matrix6 bar_stiffness(const std::array<Eigen::Vector3d, 2>& node_m, double youngs_modulus_Pa, double area_m2);
[[nodiscard]] Matrix6 string_stiffness(const std::array<Eigen::Vector3d, 2>& node_m, double pull_N);
[[nodiscard]] Matrix6 bar_mass_consistent(const std::array<Eigen::Vector3d, 2>& node_m, double mass_per_length_kg_m);
[[nodiscard]] Matrix6 bar_mass_lumped(const std::array<Eigen::Vector3d, 2>& node_m, double mass_per_length_kg_m);

/// Flat four-node shell: membrane with incompatible modes (QM6; Taylor, Beresford and Wilson 1976), drilling stiffness, and
/// discrete-Kirchhoff plate bending (DKQ; Batoz and Ben Tahar 1982), which does not lock. Slightly warped quadrilaterals are
/// projected to their mean plane, with the rigid-body correction for the distance of the nodes from it.
struct ShellGeometry {
  std::array<Eigen::Vector3d, 4> node_m;
};
struct ShellProperties {
  double youngs_modulus_Pa, poisson_ratio, thickness_m, bending_inertia_ratio;
};
enum class DrillingRule { penalty, diagonal };
/// Membrane part, drilling included: linear in E t. penalty: Hughes and Brezzi (1989) with factor gamma/G (default 1 when
/// factor is 0), incompatible modes included in the rotation; diagonal: factor·E·t·A on each corner's rotation about the normal
/// (default 0.03), which acts against ground and so resists a rigid rotation in the plane too (kept for comparison with models
/// that use it).
/// @throws InputError (all shell functions but shell_area) for a quadrilateral without area or not convex
[[nodiscard]] Matrix24 shell_membrane_stiffness(const ShellGeometry& geometry, const ShellProperties& properties,
                                                DrillingRule drilling, double drilling_factor);
/// Bending part, linear in E t³ · bending_inertia_ratio; rx = dw/dy, ry = -dw/dx at the corners.
[[nodiscard]] Matrix24 shell_bending_stiffness(const ShellGeometry& geometry, const ShellProperties& properties);
/// Consistent mass of `mass_per_area` [kg/m²]: bilinear translations; `rotary_per_area` [kg] (rho t³/12) on the bending
/// rotations; drilling rotations have none.
[[nodiscard]] Matrix24 shell_mass(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area);
/// Row sums of the same on the diagonal of each corner.
[[nodiscard]] Matrix24 shell_mass_lumped(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area);
[[nodiscard]] double shell_area(const ShellGeometry& geometry);

}  // namespace twindeck::fe
