#pragma once

#include <Eigen/Core>
#include <array>

/// Eight-node solid (hexahedron) with incompatible modes, as pure functions: translations of eight nodes, global axes, order
/// x y z of node 1, x y z of node 2, … (24 × 24).
///
/// Nodes 1-4 go round one face so that (x2 - x1) × (x4 - x1) points towards the opposite face, nodes 5-8 round that face, each
/// above its partner: the order of VTK_HEXAHEDRON, C3D8 and most meshers.
///
/// Displacements  u = sum N_i(ξ) u_i + sum P_m(ξ) a_m  with N_i trilinear and P = 1-ξ², 1-η², 1-ζ² inside of the element alone
/// (Wilson, Taylor, Doherty and Ghaboussi 1973): a brick then bends without parasitic shear and does not stiffen with
/// Poisson's ratio through its depth. Derivatives of P are taken with the Jacobian J_0 of the centre,
/// dP/dx = (det J_0 / det J) J_0⁻¹ dP/dξ, so that ∫ dP/dx dV = 0 for every shape and the patch test holds on distorted meshes
/// too (Taylor, Beresford and Wilson 1976). The nine a_m are condensed: K = K_uu - K_ua K_aa⁻¹ K_au.
namespace twindeck::fe {

using MatrixSolid = Eigen::Matrix<double, 24, 24>;

struct SolidGeometry {
  std::array<Eigen::Vector3d, 8> node_m;
};
struct SolidProperties {
  double youngs_modulus_Pa, poisson_ratio;  ///< isotropic; -1 < nu < 0.5
};

/// Shape of an element: `least_ratio` is the smallest det J at the 27 points of the mass over the mean; 1 for a parallelepiped,
/// 0 where the element is flat, negative where it is folded or inside out. The corners are not used: one corner of MacNeal
/// and Harder's patch of solids has a negative Jacobian, but the element is regular at all integration points.
struct SolidShape {
  double volume_m3;  ///< signed: negative if the nodes run the wrong way round
  double least_ratio;
  int least_corner;  ///< 0-7, the corner nearest to where it occurs
};
/// Whether an element of this shape has a stiffness: a volume, and a positive Jacobian wherever it is integrated.
[[nodiscard]] constexpr bool is_sound(const SolidShape& shape) {
  constexpr double least = 1e-6;  ///< [-] of the mean Jacobian; below, strains are those of a flat element
  return shape.volume_m3 > 0.0 && shape.least_ratio > least;
}
[[nodiscard]] SolidShape solid_shape(const SolidGeometry& geometry);

/// Stiffness with 2 × 2 × 2 Gauss points; linear in E.
/// @throws InputError for an element without volume, folded or inside out
[[nodiscard]] MatrixSolid solid_stiffness(const SolidGeometry& geometry, const SolidProperties& properties);
/// Geometric stiffness of the stresses σ = D (strain of `displacement`, internal displacements included) at the eight Gauss
/// points:  K_G = ∫ ∇Nᵀ σ ∇N dV  for each of the three displacements.
/// @param displacement  (24) that strains the element, global axes
[[nodiscard]] MatrixSolid solid_geometric_stiffness(const SolidGeometry& geometry, const SolidProperties& properties,
                                                    const Eigen::Ref<const Eigen::VectorXd>& displacement);
/// Consistent mass ρ ∫ NᵀN dV with 3 × 3 × 3 points: exact for every shape.
[[nodiscard]] MatrixSolid solid_mass(const SolidGeometry& geometry, double density_kg_m3);
/// Row sums of the consistent mass on the diagonal, ρ ∫ N_i dV at node i: positive for every admissible shape.
[[nodiscard]] MatrixSolid solid_mass_lumped(const SolidGeometry& geometry, double density_kg_m3);

}  // namespace twindeck::fe
