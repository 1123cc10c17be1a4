#pragma once

#include <Eigen/Core>
#include <array>

#include "fe/element_matrices.hpp"
#include "fe/model.hpp"

namespace twindeck::fe {

/// Flat four-node shell: membrane with incompatible modes (QM6; Taylor, Beresford and Wilson 1976), drilling stiffness, and
/// discrete-Mindlin plate bending (DKMQ; Katili 1993, IJNME 36, 1885-1908), which does not lock. Rigid in transverse shear it
/// is the discrete-Kirchhoff one (DKQ; Batoz and Ben Tahar 1982). Slightly warped quadrilaterals are projected to their mean
/// plane, with the rigid-body correction for the distance of the nodes from it.
struct ShellGeometry {
  std::array<Eigen::Vector3d, 4> node_m;
};
struct ShellProperties {
  double youngs_modulus_Pa, poisson_ratio, thickness_m, bending_inertia_ratio;
  double shear_thickness_ratio = 0.0;  ///< κ; 0: rigid in transverse shear
  /// 12 D_b / D_s [m²], D_b the bending and D_s the transverse shear stiffness of the plate: φ of a side times its length
  /// squared. 0: rigid in shear.
  [[nodiscard]] double shear_length2_m2() const {
    if (shear_thickness_ratio == 0.0) return 0.0;
    return 2.0 * bending_inertia_ratio * thickness_m * thickness_m / (shear_thickness_ratio * (1.0 - poisson_ratio));
  }
};
using DrillingRule = Formulation::Drilling;
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

/// Bending part with transverse shear, homogeneous of degree 1 in E t³ · bending_inertia_ratio and E t · shear_thickness_ratio.
/// Rigid in shear it is linear in the first, and rx = dw/dy, ry = -dw/dx at the corners.
[[nodiscard]] Matrix24 shell_bending_stiffness(const ShellGeometry& geometry, const ShellProperties& properties);

/// Consistent mass of `mass_per_area` [kg/m²]: bilinear translations; `rotary_per_area` [kg] (rho t³/12) on the bending
/// rotations; drilling rotations have none.
[[nodiscard]] Matrix24 shell_mass(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area);
/// Row sums of the same on the diagonal of each corner.
[[nodiscard]] Matrix24 shell_mass_lumped(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area);
[[nodiscard]] double shell_area(const ShellGeometry& geometry);

/// Spread of the diagonal drilling rule over a shell's corners: adds -k/3 n n' between the rotations of every two corners,
/// where k = factor·E·t·A stands on each corner's rotation about the normal n (DrillingRule::diagonal). Rows of the total, k
/// (δ_ij - (1 - δ_ij)/3), sum to zero: equal rotations of all corners meet no resistance. The diagonal alone would tie the
/// rotations to ground. Over a deck of hundreds of shells this would be a false stiffness in plan (a radial mode of the Ponte
/// del Mare rises by 17 %). Reference: Zienkiewicz and Taylor (2000), The Finite Element Method, vol. 2, section 6.5 (there
/// with -1/2 for triangles).
/// @param factor  0 = the default 0.03 of DrillingRule::diagonal
[[nodiscard]] Matrix24 drilling_spread(const ShellGeometry& geometry, const ShellProperties& properties, double factor);

}  // namespace twindeck::fe
