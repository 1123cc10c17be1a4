#include "fe/shell_quad.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "fe/element_products.hpp"
#include "fe/shell_frame.hpp"

namespace twindeck::fe {

namespace {

using Matrix3x12 = Eigen::Matrix<double, 3, 12>;  // columns u v rz of the four corners
using Matrix3x4 = Eigen::Matrix<double, 3, 4>;    // columns u and v of the modes 1-ξ², then 1-η²
using Row12 = Eigen::Matrix<double, 1, 12>;
using Row4 = Eigen::Matrix<double, 1, 4>;

/// d/dx, d/dy of the modes 1-ξ² and 1-η². The Jacobian is that of the centre, scaled by its determinant (Taylor, Beresford and
/// Wilson 1976): the integrals of these derivatives then vanish whatever the shape, which is what the patch test asks for.
Eigen::Matrix2d incompatible_gradient(const shell::Bilinear& centre, double determinant, double xi, double eta) {
  Eigen::Matrix2d natural;  // columns: the two modes; rows: d/dξ, d/dη
  natural << -2.0 * xi, 0.0, 0.0, -2.0 * eta;
  return centre.determinant / determinant * centre.inverse * natural;
}

void add_strain(double dx, double dy, int column, auto& strain) {
  strain(0, column) = dx;
  strain(1, column + 1) = dy;
  strain(2, column) = dy;
  strain(2, column + 1) = dx;
}

struct MembraneParts {
  Eigen::Matrix<double, 12, 12> whole = Eigen::Matrix<double, 12, 12>::Zero();
  Eigen::Matrix<double, 12, 4> coupling = Eigen::Matrix<double, 12, 4>::Zero();
  Eigen::Matrix4d inner = Eigen::Matrix4d::Zero();
};

Matrix3x12 corner_strain(const shell::Bilinear& at) {
  Matrix3x12 b = Matrix3x12::Zero();
  for (int i = 0; i < 4; ++i) add_strain(at.gradient(0, i), at.gradient(1, i), 3 * i, b);
  return b;
}

Matrix3x4 mode_strain(const Eigen::Matrix2d& mode) {
  Matrix3x4 g = Matrix3x4::Zero();
  for (int m = 0; m < 2; ++m) add_strain(mode(0, m), mode(1, m), 2 * m, g);
  return g;
}

/// QM6 before the incompatible modes are condensed, with, for the penalty rule, the term ½ gamma ∫ (rz - ½ (dv/dx - du/dy))² dA
/// of Hughes and Brezzi (1989). The incompatible modes take part in the rotation too, so that in-plane bending is exact on
/// parallelograms and rz is its true rotation. Unit E and thickness.
MembraneParts membrane(const shell::Frame& frame, double poisson_ratio, double gamma) {
  const Eigen::Matrix3d d = shell::plane_stress(poisson_ratio);
  const shell::Bilinear centre = shell::bilinear_at(frame, 0.0, 0.0);
  MembraneParts parts;
  for (const Eigen::Vector2d& point : shell::gauss_2x2()) {
    const shell::Bilinear at = shell::bilinear_at(frame, point.x(), point.y());
    const Eigen::Matrix2d mode = incompatible_gradient(centre, at.determinant, point.x(), point.y());
    const Matrix3x12 b = corner_strain(at);
    const Matrix3x4 g = mode_strain(mode);
    Row12 spin = Row12::Zero();
    Row4 mode_spin = Row4::Zero();
    for (int i = 0; i < 4; ++i) {
      spin(3 * i) = 0.5 * at.gradient(1, i);
      spin(3 * i + 1) = -0.5 * at.gradient(0, i);
      spin(3 * i + 2) = at.value[i];
    }
    for (int m = 0; m < 2; ++m) {
      mode_spin(2 * m) = 0.5 * mode(1, m);
      mode_spin(2 * m + 1) = -0.5 * mode(0, m);
    }
    parts.whole += at.determinant * (quadratic_form(1.0, b, d) + gamma * spin.transpose() * spin);
    parts.coupling += at.determinant * (b.transpose() * d * g + gamma * spin.transpose() * mode_spin);
    parts.inner += at.determinant * (g.transpose() * d * g + gamma * mode_spin.transpose() * mode_spin);
  }
  return parts;
}

/// gamma of the penalty for E = 1; 0 for the other rule.
double penalty_of(const ShellProperties& properties, DrillingRule drilling, double drilling_factor) {
  if (drilling != DrillingRule::penalty) return 0.0;
  return (drilling_factor > 0.0 ? drilling_factor : 1.0) * 0.5 / (1.0 + properties.poisson_ratio);
}

constexpr std::array<int, 3> membrane_places = {0, 1, 5};  ///< u v rz among the six of a corner

/// d/dξ, d/dη of the eight serendipity functions: corners 0-3, then the middles of the sides 0-1, 1-2, 2-3, 3-0.
Eigen::Matrix<double, 2, 8> serendipity_gradient(double xi, double eta) {
  Eigen::Matrix<double, 2, 8> n;
  for (int i = 0; i < 4; ++i) {
    const double a = shell::kXi[static_cast<std::size_t>(i)], b = shell::kEta[static_cast<std::size_t>(i)];
    n(0, i) = 0.25 * a * (1.0 + b * eta) * (2.0 * a * xi + b * eta);
    n(1, i) = 0.25 * b * (1.0 + a * xi) * (2.0 * b * eta + a * xi);
  }
  n.col(4) << -xi * (1.0 - eta), -0.5 * (1.0 - xi * xi);
  n.col(5) << 0.5 * (1.0 - eta * eta), -eta * (1.0 + xi);
  n.col(6) << -xi * (1.0 + eta), 0.5 * (1.0 - xi * xi);
  n.col(7) << -0.5 * (1.0 - eta * eta), -eta * (1.0 - xi);
  return n;
}

/// d/dx, d/dy of w plus β where the shear strain is constant along ξ between sides 0-1 and 2-3, and along η likewise.
Eigen::Matrix<double, 2, 12> shear_strain(const shell::PlateSides<4>& sides, const shell::Bilinear& at, double xi, double eta) {
  Eigen::Matrix<double, 2, 12> natural;
  natural.row(0) = 0.25 * ((1.0 - eta) * sides.shear[0] - (1.0 + eta) * sides.shear[2]);
  natural.row(1) = 0.25 * ((1.0 + xi) * sides.shear[1] - (1.0 - xi) * sides.shear[3]);
  return at.inverse * natural;
}

/// Unit E t³ (12 × 12).
Eigen::Matrix<double, 12, 12> bending(const shell::Frame& frame, double poisson_ratio, double shear_length2_m2) {
  const auto sides = shell::plate_sides(frame.corner_m, shear_length2_m2);
  const Eigen::Matrix3d d = shell::plane_stress(poisson_ratio) / 12.0;
  const double shear = shell::unit_shear(poisson_ratio, shear_length2_m2);
  Eigen::Matrix<double, 12, 12> k = Eigen::Matrix<double, 12, 12>::Zero();
  for (const Eigen::Vector2d& point : shell::gauss_2x2()) {
    const shell::Bilinear at = shell::bilinear_at(frame, point.x(), point.y());
    const Eigen::Matrix<double, 2, 8> gradient = at.inverse * serendipity_gradient(point.x(), point.y());
    k += quadratic_form(at.determinant, shell::curvature_of(sides.beta, gradient), d);
    if (shear == 0.0) continue;
    const Eigen::Matrix<double, 2, 12> strain = shear_strain(sides, at, point.x(), point.y());
    k += shear * at.determinant * strain.transpose() * strain;
  }
  return k;
}

}  // namespace

Matrix24 shell_membrane_stiffness(const ShellGeometry& geometry, const ShellProperties& properties, DrillingRule drilling,
                                  double drilling_factor) {
  const shell::Frame frame = shell::frame_of(geometry);
  const bool penalty = drilling == DrillingRule::penalty;
  const MembraneParts parts = membrane(frame, properties.poisson_ratio, penalty_of(properties, drilling, drilling_factor));
  Eigen::Matrix<double, 12, 12> plane = parts.whole - parts.coupling * parts.inner.ldlt().solve(parts.coupling.transpose());
  if (!penalty) {
    // factor·E·t·A on each corner's drilling rotation, grounded: it also resists a rigid turn in the plane.
    const double factor = drilling_factor > 0.0 ? drilling_factor : 0.03;
    for (int i = 0; i < 4; ++i) plane(3 * i + 2, 3 * i + 2) += factor * shell_area(geometry);
  }
  return congruence(shell::corner_displacements(frame), shell::placed(plane, membrane_places),
                    properties.youngs_modulus_Pa * properties.thickness_m);
}

Matrix24 shell_geometric_stiffness(const ShellGeometry& geometry, const ShellProperties& properties, DrillingRule drilling,
                                   double drilling_factor, const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  const shell::Frame frame = shell::frame_of(geometry);
  const Matrix24 turn = shell::corner_displacements(frame);
  const Eigen::VectorXd corners = turn * displacement;
  Eigen::Matrix<double, 12, 1> plane;
  for (int i = 0; i < 12; ++i) plane[i] = corners[6 * (i / 3) + membrane_places[static_cast<std::size_t>(i % 3)]];
  const MembraneParts parts = membrane(frame, properties.poisson_ratio, penalty_of(properties, drilling, drilling_factor));
  const Eigen::Vector4d modes = -parts.inner.ldlt().solve(parts.coupling.transpose() * plane);
  const Eigen::Matrix3d d =
      properties.youngs_modulus_Pa * properties.thickness_m * shell::plane_stress(properties.poisson_ratio);
  const shell::Bilinear centre = shell::bilinear_at(frame, 0.0, 0.0);
  Eigen::Matrix4d slope = Eigen::Matrix4d::Zero();
  for (const Eigen::Vector2d& point : shell::gauss_2x2()) {
    const shell::Bilinear at = shell::bilinear_at(frame, point.x(), point.y());
    const Eigen::Matrix2d gradient = incompatible_gradient(centre, at.determinant, point.x(), point.y());
    const Eigen::Vector3d n = d * (corner_strain(at) * plane + mode_strain(gradient) * modes);
    Eigen::Matrix2d force;
    force << n[0], n[2], n[2], n[1];
    slope += at.determinant * at.gradient.transpose() * force * at.gradient;
  }
  return congruence(turn, shell::at_corners(slope, 1.0), 1.0);
}

Matrix24 shell_bending_stiffness(const ShellGeometry& geometry, const ShellProperties& properties) {
  const shell::Frame frame = shell::frame_of(geometry);
  const Eigen::Matrix<double, 12, 12> plate = bending(frame, properties.poisson_ratio, properties.shear_length2_m2());
  const double t = properties.thickness_m;
  const double scale = properties.youngs_modulus_Pa * t * t * t * properties.bending_inertia_ratio;
  return congruence(shell::corner_displacements(frame), shell::placed(plate, {2, 3, 4}), scale);
}

double shell_area(const ShellGeometry& geometry) {
  const auto& x = geometry.node_m;
  return 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
}

/// Translations are interpolated from the nodes themselves (no rigid arms), so that the mass of a warped element stays where
/// its nodes are. Drilling rotations carry no mass.
Matrix24 shell_mass(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area) {
  const shell::Frame frame = shell::frame_of(geometry);
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  for (const Eigen::Vector2d& point : shell::gauss_2x2()) {
    const shell::Bilinear at = shell::bilinear_at(frame, point.x(), point.y());
    products += at.determinant * at.value * at.value.transpose();
  }
  const Eigen::Matrix3d in_plane = Eigen::Matrix3d::Identity() - frame.axes.row(2).transpose() * frame.axes.row(2);
  return shell::at_corners(products, mass_per_area, rotary_per_area, in_plane);
}

Matrix24 shell_mass_lumped(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area) {
  const Matrix24 consistent = shell_mass(geometry, mass_per_area, rotary_per_area);
  Matrix24 m = Matrix24::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (const int d : {0, 3}) m.block<3, 3>(6 * i + d, 6 * i + d) += consistent.block<3, 3>(6 * i + d, 6 * j + d);
  return m;
}

Matrix24 drilling_spread(const ShellGeometry& geometry, const ShellProperties& properties, double factor) {
  const auto& x = geometry.node_m;
  const Eigen::Vector3d n = (x[2] - x[0]).cross(x[3] - x[1]).normalized();  // of the mean plane
  const double k =
      (factor > 0.0 ? factor : 0.03) * properties.youngs_modulus_Pa * properties.thickness_m * shell_area(geometry);
  Matrix24 spread = Matrix24::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i != j) spread.block<3, 3>(6 * i + 3, 6 * j + 3) = -k / 3.0 * n * n.transpose();
  return spread;
}

}  // namespace twindeck::fe
