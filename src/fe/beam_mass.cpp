#include "fe/beam_frame.hpp"

namespace twindeck::fe {

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
    local += weight * properties.area_m2 * shape.deflection.transpose() * shape.deflection;
    if (rotary_inertia) local += weight * shape.section_slope.transpose() * moments * shape.section_slope;
  }
  const auto add_linear = [&local](int a, int b, double total) {
    local(a, a) += total / 3.0;
    local(b, b) += total / 3.0;
    local(a, b) += total / 6.0;
    local(b, a) += total / 6.0;
  };
  add_linear(0, 6, density_kg_m3 * properties.area_m2 * length);
  add_linear(3, 9, density_kg_m3 * (properties.inertia_y_m4 + properties.inertia_z_m4) * length);

  Matrix12 t = beam::end_displacements(geometry);
  if (geometry.releases != 0)
    t = (beam::release_transformation(beam::local_stiffness(properties, length), geometry.releases) * t).eval();
  const Matrix12 m = t.transpose() * local * t;
  return 0.5 * (m + m.transpose());
}

}  // namespace twindeck::fe
