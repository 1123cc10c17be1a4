#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fe/bar.hpp"
#include "fe/beam.hpp"
#include "fe/model.hpp"
#include "fe/shell_quad.hpp"
#include "fe/shell_triangle.hpp"
#include "fe/solid.hpp"
#include "fe/solid_quadratic.hpp"
#include "fe/tetrahedron.hpp"

/// Converts the model's data to the arguments of the element functions. Gives each matrix its positions in the whole.
namespace twindeck::fe {

/// A small symmetric matrix over full degrees of freedom (6·node + direction).
struct ElementMatrix {
  std::vector<int> dofs;   ///< (n)
  Eigen::MatrixXd matrix;  ///< (n × n)
};

[[nodiscard]] inline const Element& element_at(const Model& model, int i) { return model.elements[slot(i)]; }

[[nodiscard]] BeamGeometry beam_geometry(const Model& model, const Element& element);
/// Section and material of a beam. Shear areas are zero if the formulation is rigid in shear.
[[nodiscard]] BeamStiffnessProperties beam_properties(const Model& model, const Element& element);
/// The same at both ends; they differ for a tapered beam (section2 given).
[[nodiscard]] TaperedProperties beam_end_properties(const Model& model, const Element& element);
/// Whether a shell has three nodes.
[[nodiscard]] inline bool is_triangle(const Element& element) {
  return element.type == ElementType::shell && element.nodes.size() == 3;
}
/// @pre four nodes
[[nodiscard]] ShellGeometry shell_geometry(const Model& model, const Element& element);
/// @pre three nodes
[[nodiscard]] TriangleGeometry triangle_geometry(const Model& model, const Element& element);
/// Section and material of a shell. Its shear ratio is zero if the formulation is rigid in shear.
[[nodiscard]] ShellProperties shell_properties(const Model& model, const Element& element);
/// Whether a solid has four nodes.
[[nodiscard]] inline bool is_tetrahedron(const Element& element) {
  return element.type == ElementType::solid && element.nodes.size() == 4;
}
/// Whether a solid has nodes in the middles of its edges.
[[nodiscard]] inline bool is_quadratic(const Element& element) {
  return element.type == ElementType::solid && (element.nodes.size() == 10 || element.nodes.size() == 20);
}
/// @pre ten or twenty nodes
[[nodiscard]] QuadraticSolid quadratic_solid(const Model& model, const Element& element);
/// @pre eight nodes
[[nodiscard]] SolidGeometry solid_geometry(const Model& model, const Element& element);
/// @pre four nodes
[[nodiscard]] TetrahedronGeometry tetrahedron_geometry(const Model& model, const Element& element);
/// Stiffness of a solid of four, eight, ten or twenty nodes, over its three degrees of freedom a node.
[[nodiscard]] Eigen::MatrixXd solid_stiffness_of(const Model& model, const Element& element);
/// Geometric stiffness of its stresses under `displacement` (3 a node, global axes), over the same.
[[nodiscard]] Eigen::MatrixXd solid_geometric_stiffness_of(const Model& model, const Element& element,
                                                           const Eigen::VectorXd& displacement);
/// Membrane part of a shell of three or four nodes, the drilling of the formulation's rule included (spread over the corners
/// where the rule is diagonal); bending part with transverse shear. Over its six degrees of freedom a node.
/// @param straight_sides  of this element, from sides_beside_four_nodes; used for triangles only
[[nodiscard]] Eigen::MatrixXd shell_membrane_of(const Model& model, const Element& element, std::uint8_t straight_sides);
[[nodiscard]] Eigen::MatrixXd shell_bending_of(const Model& model, const Element& element);
/// What of the bending part goes with the transverse shear stiffness: κ dK/dκ, zero where the shell is rigid in shear. The rest
/// goes with the stiffness of the curvatures, E t³ · bending_inertia_ratio, because K is homogeneous of degree 1 in both.
[[nodiscard]] Eigen::MatrixXd shell_shear_of(const Model& model, const Element& element);
[[nodiscard]] std::array<Eigen::Vector3d, 2> end_nodes(const Model& model, const Element& element);

[[nodiscard]] const Material& material_of(const Model& model, const Element& element);
/// @pre the element is not a solid, which has no section
[[nodiscard]] const Section& section_of(const Model& model, const Element& element);

/// All six degrees of freedom of the element's nodes; the first three of each.
[[nodiscard]] std::vector<int> six_per_node(const Element& element);
[[nodiscard]] std::vector<int> three_per_node(const Element& element);

/// Mass of an element of any type, consistent or lumped as the formulation says. Stays always have half of it at each end.
[[nodiscard]] ElementMatrix element_mass(const Model& model, const Element& element);
/// Displacement e = d·(u₁ - u₂) of a spring as coefficients of its degrees of freedom; rotations where it acts on them.
struct Elongation {
  std::vector<int> dofs;
  Eigen::VectorXd coefficient;
};
[[nodiscard]] Elongation elongation_of(const Spring& spring);
/// Stiffness k d d' of a spring.
[[nodiscard]] ElementMatrix spring_stiffness(const Spring& spring);
/// Mass of a beam of these end sections, of a shell of this mass and rotary inertia per area; consistent or lumped.
[[nodiscard]] ElementMatrix beam_mass_of(const Model& model, const Element& element, const BeamGeometry& geometry,
                                         const TaperedProperties& ends);
[[nodiscard]] ElementMatrix shell_mass_of(const Model& model, const Element& element, double mass_per_area,
                                          double rotary_per_area);
/// Diagonal of a point mass and its rotary inertia.
[[nodiscard]] ElementMatrix point_mass(const PointMass& mass);
/// Whether a spring is part of K: it is active and not in series with a dashpot, which cannot carry a steady force.
[[nodiscard]] bool carries_stiffness(const Spring& spring);

/// Sides of three-node shells that a four-node shell has too. A triangle's sides bend with the rotations of their ends, those
/// of a four-node shell stay straight; on a common side the triangle's has to stay straight as well, or the mesh would not pass
/// the patch test of constant membrane stress (triangle.hpp).
/// @return (n_elements) bit i set: the side from the element's node i to the next; 0 for all but triangles
[[nodiscard]] std::vector<std::uint8_t> sides_beside_four_nodes(const Model& model);

}  // namespace twindeck::fe
