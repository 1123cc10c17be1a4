#include "fe/beam.hpp"

#include <Eigen/Dense>
#include <cmath>

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

namespace {

using beam::local_stiffness;

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

/// A matrix over the local end displacements, in global axes at the nodes; released displacements follow statically.
template <typename Properties>
Matrix12 at_nodes(const BeamGeometry& geometry, const Properties& properties, const Matrix12& local) {
  Matrix12 t = beam::end_displacements(geometry);
  if (geometry.releases != 0)
    t = (beam::release_transformation(local_stiffness(properties, beam_length(geometry)), geometry.releases) * t).eval();
  return congruence(t, local);
}

template <typename Properties>
double axial_force(const BeamGeometry& geometry, const Properties& properties, const Vector12& u) {
  const Matrix12 local = local_stiffness(properties, beam_length(geometry));
  const Vector12 ends = beam::release_transformation(local, geometry.releases) * (beam::end_displacements(geometry) * u);
  return local(6, 6) * (ends[6] - ends[0]);
}

}  // namespace

Matrix12 beam_stiffness(const BeamGeometry& geometry, const BeamStiffnessProperties& properties) {
  return at_nodes(geometry, properties, local_stiffness(properties, beam_length(geometry)));
}

double beam_axial_force(const BeamGeometry& geometry, const BeamStiffnessProperties& properties, const Vector12& u) {
  return axial_force(geometry, properties, u);
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
  return axial_force(geometry, properties, u);
}

}  // namespace twindeck::fe
