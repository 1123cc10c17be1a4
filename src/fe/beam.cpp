#include "fe/beam.hpp"

#include <Eigen/Dense>

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

namespace beam {

Eigen::Matrix2d area_moments(const BeamStiffnessProperties& p) {
  Eigen::Matrix2d i;
  i << p.inertia_z_m4, p.inertia_yz_m4, p.inertia_yz_m4, p.inertia_y_m4;
  return i;
}

Eigen::Matrix2d shear_parameter(const BeamStiffnessProperties& p, double length_m) {
  // Shear areas are given along the local axes; A_y resists the deflection v, A_z the deflection w. Zero means rigid in shear.
  const double cy = p.shear_area_y_m2 > 0.0 ? 1.0 / (p.shear_modulus_Pa * p.shear_area_y_m2) : 0.0;
  const double cz = p.shear_area_z_m2 > 0.0 ? 1.0 / (p.shear_modulus_Pa * p.shear_area_z_m2) : 0.0;
  const Eigen::Vector2d compliance(cy, cz);
  return 12.0 * p.youngs_modulus_Pa / (length_m * length_m) * area_moments(p) * compliance.asDiagonal();
}

/// Argyris' natural modes: extension, twist, a constant curvature ψ₂-ψ₁ with stiffness D/L, and the antisymmetric mode
/// q L = L (ψ₁+ψ₂)/2 - (w₂-w₁) with stiffness S = (1+Φ)⁻¹ 12 D/L³, in which bending and shear flexibilities are in series.
Matrix12 local_stiffness(const BeamStiffnessProperties& p, double length_m) {
  const double l = length_m;
  const Eigen::Matrix2d d = p.youngs_modulus_Pa * area_moments(p);
  const Eigen::Matrix2d phi = shear_parameter(p, l);
  Eigen::Matrix2d s = (Eigen::Matrix2d::Identity() + phi).inverse() * (12.0 / (l * l * l) * d);
  s = (0.5 * (s + s.transpose())).eval();  // symmetric but for rounding
  const Matrix2x12 bend = slope_of(1) - slope_of(0);
  const Matrix2x12 sway = 0.5 * l * (slope_of(0) + slope_of(1)) - (deflection_of(1) - deflection_of(0));
  Matrix12 k = quadratic_form(1.0, bend, d / l);
  k += quadratic_form(1.0, sway, s);
  add_spring(k, 0, 6, p.youngs_modulus_Pa * p.area_m2 / l);
  add_spring(k, 3, 9, p.shear_modulus_Pa * p.torsion_m4 / l);
  return k;
}

Matrix12 release_transformation(const Matrix12& stiffness, std::uint16_t releases) {
  Matrix12 k = stiffness;
  Matrix12 t = Matrix12::Identity();
  for (int i = 0; i < 12; ++i) {
    if ((releases >> i & 1U) == 0U) continue;
    // One at a time: u_i = -(k_i· u)/k_ii over the other displacements, with the stiffness left by the releases before it.
    Vector12 row = Vector12::Zero();
    if (k(i, i) > 1e-12 * stiffness(i, i)) row = -k.row(i).transpose() / k(i, i);
    row[i] = 0.0;
    Matrix12 step = Matrix12::Identity();
    step.row(i) = row;
    t = (t * step).eval();
    k = (step.transpose() * k * step).eval();
    k.row(i).setZero();
    k.col(i).setZero();
  }
  return t;
}

}  // namespace beam

Matrix12 beam_stiffness(const BeamGeometry& geometry, const BeamStiffnessProperties& properties) {
  const Matrix12 local = beam::local_stiffness(properties, beam_length(geometry));
  const Matrix12 t = beam::release_transformation(local, geometry.releases) * beam::end_displacements(geometry);
  return congruence(t, local);
}

double beam_axial_force(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, const Vector12& u) {
  const double length = beam_length(geometry);
  const Matrix12 local = beam::local_stiffness(properties, length);
  const Vector12 ends = beam::release_transformation(local, geometry.releases) * (beam::end_displacements(geometry) * u);
  return properties.youngs_modulus_Pa * properties.area_m2 / length * (ends[6] - ends[0]);
}

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

/// K_G = N ∫ (dw/dx)ᵀ (dw/dx) dx with Hermite cubics. The twist term N (Iy+Iz)/A (Wagner) is left out: it matters for open
/// thin-walled sections alone. Released rotations follow as those of a slender beam, for which the shapes do not depend on EI.
Matrix12 beam_geometric_stiffness(const BeamGeometry& geometry, double axial_force_N) {
  const double length = beam_length(geometry);
  Matrix12 local = Matrix12::Zero();
  for (const beam::GaussPoint& point : beam::gauss_points()) {
    const beam::Shape shape = beam::shape_at(point.xi, length, Eigen::Matrix2d::Zero());
    local += quadratic_form(axial_force_N * length * point.weight, shape.deflection_slope);
  }
  const BeamStiffnessProperties slender{1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0};
  return at_nodes(geometry, slender, local);
}

}  // namespace twindeck::fe
