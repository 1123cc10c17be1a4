#include "fe/beam_tapered.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "fe/beam_frame.hpp"
#include "fe/element_products.hpp"

namespace twindeck::fe {

namespace {

using beam::Matrix2x12;

/// Eight Gauss points on [0, 1].
std::array<beam::GaussPoint, 8> eight_points() {
  constexpr std::array<double, 4> a = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> w = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  std::array<beam::GaussPoint, 8> points{};
  for (std::size_t i = 0; i < 4; ++i) {
    points[2 * i] = {0.5 * (1.0 - a[i]), 0.5 * w[i]};
    points[2 * i + 1] = {0.5 * (1.0 + a[i]), 0.5 * w[i]};
  }
  return points;
}

double root_blend(double a, double b, double xi, double power) {
  return std::pow((1.0 - xi) * std::pow(a, 1.0 / power) + xi * std::pow(b, 1.0 / power), power);
}

/// Correlation Iyz / √(Iy Iz) of a section.
double skewness(const BeamStiffnessProperties& p) {
  const double product = p.inertia_y_m4 * p.inertia_z_m4;
  return product > 0.0 ? p.inertia_yz_m4 / std::sqrt(product) : 0.0;
}

/// Stiffness of ∫ dx/(E A) or ∫ dx/(G J), zero for a section without.
double in_series(double sum) { return std::isfinite(sum) && sum > 0.0 ? 1.0 / sum : 0.0; }

/// The section at ξ ∈ [0, 1].
BeamStiffnessProperties section_at(const TaperedProperties& properties, double xi) {
  const BeamStiffnessProperties &a = properties.end1, &b = properties.end2;
  BeamStiffnessProperties s = a;
  s.area_m2 = root_blend(a.area_m2, b.area_m2, xi, 2.0);
  s.shear_area_y_m2 = root_blend(a.shear_area_y_m2, b.shear_area_y_m2, xi, 2.0);
  s.shear_area_z_m2 = root_blend(a.shear_area_z_m2, b.shear_area_z_m2, xi, 2.0);
  s.inertia_y_m4 = root_blend(a.inertia_y_m4, b.inertia_y_m4, xi, 4.0);
  s.inertia_z_m4 = root_blend(a.inertia_z_m4, b.inertia_z_m4, xi, 4.0);
  s.torsion_m4 = root_blend(a.torsion_m4, b.torsion_m4, xi, 4.0);
  s.inertia_yz_m4 = ((1.0 - xi) * skewness(a) + xi * skewness(b)) * std::sqrt(s.inertia_y_m4 * s.inertia_z_m4);
  return s;
}

/// With end 1 clamped, loads F and m at end 2 bend the section at x by κ = D⁻¹ (m + (L-x) F) and shear it by γ = S⁻¹ F; then
/// ψ₂ = ∫ κ dx, w₂ = ∫ (L-x) κ + γ dx. The inverse of this 4 × 4 flexibility acts on w₂ - w₁ - L ψ₁ and ψ₂ - ψ₁.
Matrix12 local_stiffness(const TaperedProperties& p, double length_m) {
  const double l = length_m;
  Eigen::Matrix4d flexibility = Eigen::Matrix4d::Zero();
  double axial = 0.0, twist = 0.0;
  bool bends = true;
  for (const beam::GaussPoint& point : eight_points()) {
    const BeamStiffnessProperties s = section_at(p, point.xi);
    const double w = point.weight * l, arm = (1.0 - point.xi) * l;
    axial += w / (s.youngs_modulus_Pa * s.area_m2);
    twist += w / (s.shear_modulus_Pa * s.torsion_m4);
    const Eigen::Matrix2d d = s.youngs_modulus_Pa * beam::area_moments(s);
    bends = bends && d.determinant() > 0.0;
    if (!bends) continue;
    const Eigen::Matrix2d c = w * d.inverse();
    flexibility.topLeftCorner<2, 2>() += arm * arm * c;
    flexibility.topRightCorner<2, 2>() += arm * c;
    flexibility.bottomRightCorner<2, 2>() += c;
    if (s.shear_area_y_m2 > 0.0) flexibility(0, 0) += w / (s.shear_modulus_Pa * s.shear_area_y_m2);
    if (s.shear_area_z_m2 > 0.0) flexibility(1, 1) += w / (s.shear_modulus_Pa * s.shear_area_z_m2);
  }
  Matrix12 k = Matrix12::Zero();
  if (bends) {
    flexibility.bottomLeftCorner<2, 2>() = flexibility.topRightCorner<2, 2>().transpose();
    Eigen::Matrix<double, 4, 12> tip;
    tip.topRows<2>() = beam::deflection_of(1) - beam::deflection_of(0) - l * beam::slope_of(0);
    tip.bottomRows<2>() = beam::slope_of(1) - beam::slope_of(0);
    k = inverse_form(flexibility, tip);
    k = (0.5 * (k + k.transpose())).eval();
  }
  beam::add_spring(k, 0, 6, in_series(axial));
  beam::add_spring(k, 3, 9, in_series(twist));
  return k;
}

Matrix12 at_nodes(const BeamGeometry& geometry, const TaperedProperties& properties, const Matrix12& matrix) {
  Matrix12 t = beam::end_displacements(geometry);
  if (geometry.releases != 0)
    t = (beam::release_transformation(local_stiffness(properties, beam_length(geometry)), geometry.releases) * t).eval();
  return congruence(t, matrix);
}

}  // namespace

Matrix12 tapered_beam_stiffness(const BeamGeometry& geometry, const TaperedProperties& properties) {
  return at_nodes(geometry, properties, local_stiffness(properties, beam_length(geometry)));
}

Matrix12 tapered_beam_mass(const BeamGeometry& geometry, const TaperedProperties& properties, double density_kg_m3,
                           bool rotary_inertia) {
  const double length = beam_length(geometry);
  const Eigen::Matrix2d phi = beam::shear_parameter(section_at(properties, 0.5), length);
  Matrix12 local = Matrix12::Zero();
  for (const beam::GaussPoint& point : eight_points()) {
    const BeamStiffnessProperties s = section_at(properties, point.xi);
    const beam::Shape shape = beam::shape_at(point.xi, length, phi);
    const double weight = density_kg_m3 * length * point.weight;
    local += quadratic_form(weight * s.area_m2, shape.deflection);
    if (rotary_inertia) local += quadratic_form(weight, shape.section_slope, beam::area_moments(s));
    const Eigen::Vector2d along(1.0 - point.xi, point.xi);
    const double polar = s.inertia_y_m4 + s.inertia_z_m4;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        local(6 * i, 6 * j) += weight * s.area_m2 * along[i] * along[j];
        local(6 * i + 3, 6 * j + 3) += weight * polar * along[i] * along[j];
      }
  }
  return at_nodes(geometry, properties, local);
}

Matrix12 tapered_beam_mass_lumped(const BeamGeometry& geometry, const TaperedProperties& properties, double density_kg_m3,
                                  bool rotary_inertia) {
  Matrix12 local = Matrix12::Zero();
  for (const beam::GaussPoint& point : eight_points()) {
    const BeamStiffnessProperties s = section_at(properties, point.xi);
    const Eigen::Vector2d along(1.0 - point.xi, point.xi);
    for (int end = 0; end < 2; ++end) {
      const double weight = density_kg_m3 * beam_length(geometry) * point.weight * along[end];
      for (int d = 0; d < 3; ++d) local(6 * end + d, 6 * end + d) += weight * s.area_m2;
      local(6 * end + 3, 6 * end + 3) += weight * (s.inertia_y_m4 + s.inertia_z_m4);
      if (rotary_inertia) local += quadratic_form(weight, beam::slope_of(end), beam::area_moments(s));
    }
  }
  return at_nodes(geometry, properties, local);
}

double tapered_beam_axial_force(const BeamGeometry& geometry, const TaperedProperties& properties, const Vector12& u) {
  const Matrix12 local = local_stiffness(properties, beam_length(geometry));
  const Vector12 ends = beam::release_transformation(local, geometry.releases) * (beam::end_displacements(geometry) * u);
  return local(6, 6) * (ends[6] - ends[0]);
}

}  // namespace twindeck::fe
