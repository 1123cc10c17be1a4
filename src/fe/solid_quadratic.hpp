#pragma once

#include <Eigen/Core>
#include <vector>

#include "fe/solid.hpp"

/// Quadratic solids, as pure functions: the hexahedron of twenty nodes (serendipity) and the tetrahedron of ten, isoparametric,
/// with translations of their n nodes in global axes, order x y z of node 1, x y z of node 2, … (3n × 3n).
///
/// Corners come first, in the order of solid.hpp and tetrahedron.hpp, then the nodes in the middles of edges. Hexahedron: edges
/// 1-2, 2-3, 3-4, 4-1 of the bottom, 5-6, 6-7, 7-8, 8-5 of the top, then 1-5, 2-6, 3-7, 4-8. Tetrahedron: edges 1-2, 2-3, 3-1,
/// 1-4, 2-4, 3-4. That is the order of VTK_QUADRATIC_HEXAHEDRON and VTK_QUADRATIC_TETRA, C3D20 and C3D10, SOLID186 and
/// SOLID187.
///
/// Displacements and geometry  u = sum N_i u_i,  x = sum N_i x_i,  K = ∫ Bᵀ D B dV  with the 14 points of Irons for the
/// hexahedron (degree 5; no zero-energy mode, unlike eight points, and less stiff in thin elements than 27) and four points for
/// the tetrahedron (degree 2, exact for straight edges). Deviation: elements that their programs integrate with eight points
/// (C3D20R, SOLID186 by default) are integrated so too. References: Zienkiewicz, Taylor and Zhu (2013), The Finite Element
/// Method: Its Basis and Fundamentals, 7th ed., sections 6.2 and 6.3; Irons (1971), IJNME 3, 293-294 (points).
namespace twindeck::fe {

struct QuadraticSolid {
  std::vector<Eigen::Vector3d> node_m;  ///< 10 or 20
};

/// Shape as SolidShape tells it, over the points of stiffness and mass. `least_corner` is the node nearest to the worst one.
[[nodiscard]] SolidShape quadratic_solid_shape(const QuadraticSolid& solid);

/// Stiffness, linear in E. @throws InputError for an element without volume, folded or inside out
[[nodiscard]] Eigen::MatrixXd quadratic_solid_stiffness(const QuadraticSolid& solid, const SolidProperties& properties);
/// Geometric stiffness of the stresses at the points of the stiffness, as solid_geometric_stiffness.
/// @param displacement  (3n) that strains the element, global axes
[[nodiscard]] Eigen::MatrixXd quadratic_solid_geometric_stiffness(const QuadraticSolid& solid,
                                                                  const SolidProperties& properties,
                                                                  const Eigen::Ref<const Eigen::VectorXd>& displacement);
/// Consistent mass ρ ∫ NᵀN dV with four points a direction: exact for straight edges; its total is exact for every shape.
[[nodiscard]] Eigen::MatrixXd quadratic_solid_mass(const QuadraticSolid& solid, double density_kg_m3);
/// Diagonal of the consistent mass, scaled to the total (row sums are negative at corners). Reference: Hinton, Rock and
/// Zienkiewicz (1976), Earthquake Engineering and Structural Dynamics 4, 245-249.
[[nodiscard]] Eigen::MatrixXd quadratic_solid_mass_lumped(const QuadraticSolid& solid, double density_kg_m3);

}  // namespace twindeck::fe
