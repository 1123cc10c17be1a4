#include "fe/beam_mass.hpp"

#include "fe/beam_frame.hpp"
#include "fe/element_products.hpp"

namespace twindeck::fe {

namespace {

/// The element's matrix in global axes at the nodes, released displacements following statically.
Matrix12 at_nodes(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, const Matrix12& local) {
  Matrix12 t = beam::end_displacements(geometry);
  if (geometry.releases != 0)
    t = (beam::release_transformation(beam::local_stiffness(properties, beam_length(geometry)), geometry.releases) * t).eval();
  return congruence(t, local);
}

}  // namespace

/// The shape functions are those of the stiffness, shear flexibility included, so that mass and stiffness belong together.
/// Torsion carries its polar inertia rho (Iy + Iz) always: without it, twist would have no mass. Releases: the released
/// displacements follow statically, as in the stiffness.
Matrix12 beam_mass(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, double density_kg_m3,
                   bool rotary_inertia) {
  const double length = beam_length(geometry);
  const Eigen::Matrix2d phi = beam::shear_parameter(properties, length);
  const Eigen::Matrix2d moments = beam::area_moments(properties);
  Matrix12 local = Matrix12::Zero();
  for (const beam::GaussPoint& point : beam::gauss_points()) {
    const beam::Shape shape = beam::shape_at(point.xi, length, phi);
    const double weight = density_kg_m3 * length * point.weight;
    local += quadratic_form(weight * properties.area_m2, shape.deflection);
    if (rotary_inertia) local += quadratic_form(weight, shape.section_slope, moments);
  }
  const auto add_linear = [&local](int a, int b, double total) {
    local(a, a) += total / 3.0;
    local(b, b) += total / 3.0;
    local(a, b) += total / 6.0;
    local(b, a) += total / 6.0;
  };
  add_linear(0, 6, density_kg_m3 * properties.area_m2 * length);
  add_linear(3, 9, density_kg_m3 * (properties.inertia_y_m4 + properties.inertia_z_m4) * length);
  return at_nodes(geometry, properties, local);
}

Matrix12 beam_mass_lumped(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, double density_kg_m3,
                          bool rotary_inertia) {
  const double half = 0.5 * density_kg_m3 * beam_length(geometry);  // per area, or per moment of area
  Matrix12 local = Matrix12::Zero();
  for (int end = 0; end < 2; ++end) {
    for (int d = 0; d < 3; ++d) local(6 * end + d, 6 * end + d) = half * properties.area_m2;
    local(6 * end + 3, 6 * end + 3) = half * (properties.inertia_y_m4 + properties.inertia_z_m4);
    if (rotary_inertia) local += quadratic_form(half, beam::slope_of(end), beam::area_moments(properties));
  }
  return at_nodes(geometry, properties, local);
}

}  // namespace twindeck::fe
