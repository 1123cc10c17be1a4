#include "fe/beam.hpp"

#include <Eigen/Dense>

#include "fe/beam_frame.hpp"
#include "fe/element_products.hpp"

namespace twindeck::fe {

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
  const auto add_spring = [&k](int a, int b, double c) {
    k(a, a) += c;
    k(b, b) += c;
    k(a, b) -= c;
    k(b, a) -= c;
  };
  add_spring(0, 6, p.youngs_modulus_Pa * p.area_m2 / l);
  add_spring(3, 9, p.shear_modulus_Pa * p.torsion_m4 / l);
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

}  // namespace twindeck::fe
