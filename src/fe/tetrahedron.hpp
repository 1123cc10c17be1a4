#pragma once

#include <Eigen/Core>
#include <array>

#include "fe/solid.hpp"

/// Four-node solid (tetrahedron) of constant strain, as pure functions: translations of four nodes, global axes, order x y z of
/// node 1, x y z of node 2, … (12 × 12).
///
/// Nodes 1-3 go round one face so that (x2 - x1) × (x3 - x1) points towards node 4: the order of VTK_TETRA, C3D4 and CTETRA.
/// Displacements  u = sum L_i u_i  with the volume coordinates L_i, whose gradients are constant, so K = V Bᵀ D B. The element
/// passes the patch test and has no zero-energy mode, but it is too stiff in bending: fill corners with it, and mesh what bends
/// with hexahedra. Reference: Zienkiewicz, Taylor and Zhu (2013), The Finite Element Method: Its Basis and Fundamentals, 7th
/// ed., section 6.3.
namespace twindeck::fe {

using MatrixTetrahedron = Eigen::Matrix<double, 12, 12>;

struct TetrahedronGeometry {
  std::array<Eigen::Vector3d, 4> node_m;
};

/// Volume [m³], negative if node 4 lies on the wrong side; 0 where it is lost in the rounding of the coordinates.
[[nodiscard]] double tetrahedron_volume(const TetrahedronGeometry& geometry);
/// Stiffness, linear in E. @throws InputError for an element without volume or inside out
[[nodiscard]] MatrixTetrahedron tetrahedron_stiffness(const TetrahedronGeometry& geometry, const SolidProperties& properties);
/// Geometric stiffness of its constant stress, as solid_geometric_stiffness. @param displacement  (12), global axes
[[nodiscard]] MatrixTetrahedron tetrahedron_geometric_stiffness(const TetrahedronGeometry& geometry,
                                                                const SolidProperties& properties,
                                                                const Eigen::Ref<const Eigen::VectorXd>& displacement);
/// Consistent mass: ρ V (1 + δ_ij) / 20 between nodes i and j. @throws InputError as above
[[nodiscard]] MatrixTetrahedron tetrahedron_mass(const TetrahedronGeometry& geometry, double density_kg_m3);
/// A quarter of the mass at each node. @throws InputError as above
[[nodiscard]] MatrixTetrahedron tetrahedron_mass_lumped(const TetrahedronGeometry& geometry, double density_kg_m3);

}  // namespace twindeck::fe
