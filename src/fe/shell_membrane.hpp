#pragma once

#include <Eigen/Core>
#include <array>

#include "fe/element_matrices.hpp"

namespace twindeck::fe {

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
/// Geometric stiffness of the membrane forces N = t D (strain of `displacement`, incompatible modes included) at the four Gauss
/// points,  K_G = ∫ ∇uᵀ N ∇u dA  for each of the three displacements on bilinear shapes; bending moments have no part in it.
/// The error of buckling loads falls with the square of the element's size.
/// @param displacement  (24) that strains the element, global axes
[[nodiscard]] Matrix24 shell_geometric_stiffness(const ShellGeometry& geometry, const ShellProperties& properties,
                                                 DrillingRule drilling, double drilling_factor,
                                                 const Eigen::Ref<const Eigen::VectorXd>& displacement);

}  // namespace twindeck::fe
