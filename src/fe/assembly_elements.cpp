#include "fe/assembly_elements.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"

namespace twindeck::fe {

namespace {

const Eigen::Vector3d& position(const Model& model, int node) { return model.nodes[static_cast<std::size_t>(node)].x_m; }

/// The places of an element's nodes, as its geometry.
template <typename Geometry>
Geometry corners_of(const Model& model, const Element& element) {
  Geometry geometry;
  TWINDECK_ASSERT(element.nodes.size() == geometry.node_m.size());
  for (std::size_t i = 0; i < element.nodes.size(); ++i) geometry.node_m[i] = position(model, element.nodes[i]);
  return geometry;
}

std::vector<int> dofs_per_node(const Element& element, int count) {
  std::vector<int> dofs;
  for (const int node : element.nodes)
    for (int d = 0; d < count; ++d) dofs.push_back(6 * node + d);
  return dofs;
}

BeamStiffnessProperties properties_with(const Model& model, const Material& m, const Section& s) {
  const double shear = model.formulation.shear_flexible ? 1.0 : 0.0;
  return {m.youngs_modulus_Pa,      m.shear_modulus_Pa, s.area_m2,    s.inertia_y_m4,
          s.inertia_z_m4,           s.inertia_yz_m4,    s.torsion_m4, shear * s.shear_area_y_m2,
          shear * s.shear_area_z_m2};
}

SolidProperties solid_properties(const Model& model, const Element& element) {
  const Material& m = material_of(model, element);
  return {m.youngs_modulus_Pa, m.poisson_ratio};
}

Eigen::MatrixXd bending_with(const Model& model, const Element& element, const ShellProperties& properties) {
  if (is_triangle(element)) return triangle_bending_stiffness(triangle_geometry(model, element), properties);
  return shell_bending_stiffness(shell_geometry(model, element), properties);
}

}  // namespace

const Material& material_of(const Model& model, const Element& element) {
  return model.materials[static_cast<std::size_t>(element.material)];
}

const Section& section_of(const Model& model, const Element& element) {
  TWINDECK_ASSERT(element.section >= 0);
  return model.sections[static_cast<std::size_t>(element.section)];
}

std::array<Eigen::Vector3d, 2> end_nodes(const Model& model, const Element& element) {
  return {position(model, element.nodes[0]), position(model, element.nodes[1])};
}

BeamGeometry beam_geometry(const Model& model, const Element& element) {
  return {end_nodes(model, element), element.offset_m, element.orientation, element.releases};
}

BeamStiffnessProperties beam_properties(const Model& model, const Element& element) {
  return properties_with(model, material_of(model, element), section_of(model, element));
}

TaperedProperties beam_end_properties(const Model& model, const Element& element) {
  const BeamStiffnessProperties first = beam_properties(model, element);
  if (element.section2 < 0) return {first, first};
  return {first,
          properties_with(model, material_of(model, element), model.sections[static_cast<std::size_t>(element.section2)])};
}

ShellGeometry shell_geometry(const Model& model, const Element& element) { return corners_of<ShellGeometry>(model, element); }

TriangleGeometry triangle_geometry(const Model& model, const Element& element) {
  return corners_of<TriangleGeometry>(model, element);
}

ShellProperties shell_properties(const Model& model, const Element& element) {
  const Material& m = material_of(model, element);
  const Section& s = section_of(model, element);
  const double shear = model.formulation.shear_flexible ? s.shear_thickness_ratio : 0.0;
  return {m.youngs_modulus_Pa, m.poisson_ratio, s.thickness_m, s.bending_inertia_ratio, shear};
}

Eigen::MatrixXd shell_membrane_of(const Model& model, const Element& element, std::uint8_t straight_sides) {
  const ShellProperties properties = shell_properties(model, element);
  if (is_triangle(element)) {
    TriangleGeometry triangle = triangle_geometry(model, element);
    triangle.straight_sides = straight_sides;
    return triangle_membrane_stiffness(triangle, properties);
  }
  const ShellGeometry geometry = shell_geometry(model, element);
  const double factor = model.formulation.drilling_factor;
  const Matrix24 k = shell_membrane_stiffness(geometry, properties, model.formulation.drilling, factor);
  if (model.formulation.drilling == DrillingRule::penalty) return k;
  return k + drilling_spread(geometry, properties, factor);
}

Eigen::MatrixXd shell_bending_of(const Model& model, const Element& element) {
  return bending_with(model, element, shell_properties(model, element));
}

Eigen::MatrixXd shell_shear_of(const Model& model, const Element& element) {
  constexpr double step = 1e-4;  ///< [-] of κ: central differences err by its square
  ShellProperties more = shell_properties(model, element), less = more;
  more.shear_thickness_ratio *= 1.0 + step;
  less.shear_thickness_ratio *= 1.0 - step;
  return (bending_with(model, element, more) - bending_with(model, element, less)) / (2.0 * step);
}

SolidGeometry solid_geometry(const Model& model, const Element& element) { return corners_of<SolidGeometry>(model, element); }

TetrahedronGeometry tetrahedron_geometry(const Model& model, const Element& element) {
  return corners_of<TetrahedronGeometry>(model, element);
}

QuadraticSolid quadratic_solid(const Model& model, const Element& element) {
  QuadraticSolid solid;
  for (const int node : element.nodes) solid.node_m.push_back(position(model, node));
  return solid;
}

Eigen::MatrixXd solid_stiffness_of(const Model& model, const Element& element) {
  const SolidProperties properties = solid_properties(model, element);
  if (is_quadratic(element)) return quadratic_solid_stiffness(quadratic_solid(model, element), properties);
  if (is_tetrahedron(element)) return tetrahedron_stiffness(tetrahedron_geometry(model, element), properties);
  return solid_stiffness(solid_geometry(model, element), properties);
}

Eigen::MatrixXd solid_geometric_stiffness_of(const Model& model, const Element& element, const Eigen::VectorXd& displacement) {
  const SolidProperties properties = solid_properties(model, element);
  if (is_quadratic(element))
    return quadratic_solid_geometric_stiffness(quadratic_solid(model, element), properties, displacement);
  if (is_tetrahedron(element))
    return tetrahedron_geometric_stiffness(tetrahedron_geometry(model, element), properties, displacement);
  return solid_geometric_stiffness(solid_geometry(model, element), properties, displacement);
}

Eigen::MatrixXd solid_mass_of(const Model& model, const Element& element) {
  const double density = material_of(model, element).density_kg_m3;
  const bool lumped = model.formulation.lumped_mass;
  if (is_quadratic(element)) {
    const QuadraticSolid solid = quadratic_solid(model, element);
    return lumped ? quadratic_solid_mass_lumped(solid, density) : quadratic_solid_mass(solid, density);
  }
  if (is_tetrahedron(element)) {
    const TetrahedronGeometry four = tetrahedron_geometry(model, element);
    return lumped ? tetrahedron_mass_lumped(four, density) : tetrahedron_mass(four, density);
  }
  const SolidGeometry geometry = solid_geometry(model, element);
  return lumped ? solid_mass_lumped(geometry, density) : solid_mass(geometry, density);
}

std::vector<int> six_per_node(const Element& element) { return dofs_per_node(element, 6); }
std::vector<int> three_per_node(const Element& element) { return dofs_per_node(element, 3); }

ElementMatrix beam_mass_of(const Model& model, const Element& element, const BeamGeometry& geometry,
                           const TaperedProperties& ends) {
  const double density = material_of(model, element).density_kg_m3;
  const bool rotary = model.formulation.beam_rotary_inertia, lumped = model.formulation.lumped_mass;
  if (element.section2 >= 0)
    return {six_per_node(element), lumped ? tapered_beam_mass_lumped(geometry, ends, density, rotary)
                                          : tapered_beam_mass(geometry, ends, density, rotary)};
  return {six_per_node(element),
          lumped ? beam_mass_lumped(geometry, ends.end1, density, rotary) : beam_mass(geometry, ends.end1, density, rotary)};
}

ElementMatrix shell_mass_of(const Model& model, const Element& element, double mass_per_area, double rotary_per_area) {
  if (is_triangle(element)) {
    const TriangleGeometry triangle = triangle_geometry(model, element);
    return {six_per_node(element), model.formulation.lumped_mass
                                       ? triangle_mass_lumped(triangle, mass_per_area, rotary_per_area)
                                       : triangle_mass(triangle, mass_per_area, rotary_per_area)};
  }
  const ShellGeometry geometry = shell_geometry(model, element);
  return {six_per_node(element), model.formulation.lumped_mass ? shell_mass_lumped(geometry, mass_per_area, rotary_per_area)
                                                               : shell_mass(geometry, mass_per_area, rotary_per_area)};
}

ElementMatrix element_mass(const Model& model, const Element& element) {
  const double density = material_of(model, element).density_kg_m3;
  const bool lumped = model.formulation.lumped_mass;
  switch (element.type) {
    case ElementType::beam:
      return beam_mass_of(model, element, beam_geometry(model, element), beam_end_properties(model, element));
    case ElementType::bar:
    case ElementType::stay: {
      const auto ends = end_nodes(model, element);
      const double per_length = density * section_of(model, element).area_m2;
      return {three_per_node(element), lumped || element.type == ElementType::stay ? bar_mass_lumped(ends, per_length)
                                                                                   : bar_mass_consistent(ends, per_length)};
    }
    case ElementType::shell: {
      const double t = section_of(model, element).thickness_m;
      const double rotary = model.formulation.shell_rotary_inertia ? density * t * t * t / 12.0 : 0.0;
      return shell_mass_of(model, element, density * t, rotary);
    }
    case ElementType::solid:
      return {three_per_node(element), solid_mass_of(model, element)};
  }
  TWINDECK_ASSERT(false);
  return {};
}

bool carries_stiffness(const Spring& spring) { return spring.active && !spring.series && spring.stiffness != 0.0; }

Elongation elongation_of(const Spring& spring) {
  Elongation e;
  const int first = spring.rotation ? 3 : 0;
  const Eigen::Vector3d d = spring.direction.normalized();
  e.coefficient.resize(spring.node2 >= 0 ? 6 : 3);
  e.coefficient.head<3>() = d;
  if (spring.node2 >= 0) e.coefficient.tail<3>() = -d;
  for (const int node : {spring.node, spring.node2})
    for (int i = 0; node >= 0 && i < 3; ++i) e.dofs.push_back(6 * node + first + i);
  return e;
}

ElementMatrix spring_stiffness(const Spring& spring) {
  const Elongation e = elongation_of(spring);
  return {e.dofs, spring.stiffness * e.coefficient * e.coefficient.transpose()};
}

ElementMatrix point_mass(const PointMass& mass) {
  ElementMatrix m;
  Eigen::Matrix<double, 6, 1> diagonal;
  diagonal << mass.mass_kg, mass.mass_kg, mass.mass_kg, mass.inertia_kg_m2;
  for (int d = 0; d < 6; ++d) m.dofs.push_back(6 * mass.node + d);
  m.matrix = diagonal.asDiagonal();
  return m;
}

std::vector<std::uint8_t> sides_beside_four_nodes(const Model& model) {
  std::vector<std::uint8_t> straight(model.elements.size(), 0);
  if (std::ranges::none_of(model.elements, is_triangle)) return straight;
  const auto side = [](const Element& e, std::size_t i) {
    return std::minmax({e.nodes[i], e.nodes[(i + 1) % e.nodes.size()]});
  };
  std::set<std::pair<int, int>> of_four;
  for (const Element& e : model.elements)
    for (std::size_t i = 0; e.type == ElementType::shell && e.nodes.size() == 4 && i < 4; ++i) of_four.insert(side(e, i));
  for (std::size_t k = 0; k < straight.size(); ++k) {
    const Element& e = model.elements[k];
    for (std::size_t i = 0; is_triangle(e) && i < 3; ++i)
      if (of_four.contains(side(e, i))) straight[k] = static_cast<std::uint8_t>(straight[k] | (1U << i));
  }
  return straight;
}

}  // namespace twindeck::fe
