#include "fe/solid.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "fe/element_products.hpp"
#include "fe/solid_strain.hpp"

namespace twindeck::fe {

namespace {

using Matrix6x24 = Eigen::Matrix<double, 6, 24>;
using Matrix6x9 = Eigen::Matrix<double, 6, 9>;
using Matrix3x8 = Eigen::Matrix<double, 3, 8>;

constexpr std::array<std::array<double, 3>, 8> kCorner = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// Trilinear map at ξ ∈ [-1, 1]³; rows of the Jacobian are d(x, y, z)/dξ, /dη, /dζ.
struct Trilinear {
  Eigen::Matrix<double, 8, 1> value;
  Matrix3x8 natural;  ///< d/dξ, d/dη, d/dζ of the eight functions
  Eigen::Matrix3d jacobian;
  double determinant;
  [[nodiscard]] Matrix3x8 gradient() const { return jacobian.inverse() * natural; }
};

Trilinear trilinear_at(const SolidGeometry& geometry, const Eigen::Vector3d& xi) {
  Trilinear t;
  t.jacobian.setZero();
  for (int i = 0; i < 8; ++i) {
    const auto& c = kCorner[static_cast<std::size_t>(i)];
    const Eigen::Vector3d f(1.0 + c[0] * xi[0], 1.0 + c[1] * xi[1], 1.0 + c[2] * xi[2]);
    t.value[i] = 0.125 * f.prod();
    t.natural.col(i) = 0.125 * Eigen::Vector3d(c[0] * f[1] * f[2], c[1] * f[0] * f[2], c[2] * f[0] * f[1]);
    t.jacobian += t.natural.col(i) * geometry.node_m[static_cast<std::size_t>(i)].transpose();
  }
  t.determinant = t.jacobian.determinant();
  return t;
}

struct GaussPoint {
  Eigen::Vector3d xi;
  double weight;
};

/// Product rule of `abscissa` and `weight`.
std::vector<GaussPoint> gauss(const std::vector<double>& abscissa, const std::vector<double>& weight) {
  std::vector<GaussPoint> points;
  for (std::size_t i = 0; i < abscissa.size(); ++i)
    for (std::size_t j = 0; j < abscissa.size(); ++j)
      for (std::size_t k = 0; k < abscissa.size(); ++k)
        points.push_back({{abscissa[i], abscissa[j], abscissa[k]}, weight[i] * weight[j] * weight[k]});
  return points;
}

const std::vector<GaussPoint>& gauss_2() {
  static const double a = 1.0 / std::sqrt(3.0);
  static const std::vector<GaussPoint> points = gauss({-a, a}, {1.0, 1.0});
  return points;
}

const std::vector<GaussPoint>& gauss_3() {
  static const double a = std::sqrt(0.6);
  static const std::vector<GaussPoint> points = gauss({-a, 0.0, a}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0});
  return points;
}

void require_sound(const SolidGeometry& geometry) {
  const SolidShape shape = solid_shape(geometry);
  if (is_sound(shape)) return;
  const Eigen::Vector3d& x = geometry.node_m[0];
  throw InputError({},
                   fmt::format("solid with first corner ({:.6g}, {:.6g}, {:.6g}) m has volume {:.3g} m3 and a corner with "
                               "{:.3g} of the mean Jacobian, expected both positive",
                               x.x(), x.y(), x.z(), shape.volume_m3, shape.least_ratio),
                   "give four corners round one face, then the four above them in the same order");
}

Matrix6x24 strain_at(const Trilinear& t) {
  const Matrix3x8 gradient = t.gradient();
  Matrix6x24 b;
  for (int i = 0; i < 8; ++i) set_strain(gradient.col(i), i, b);
  return b;
}

/// Strains of the nine internal displacements.
Matrix6x9 internal_strain_at(const Eigen::Matrix3d& centre_inverse, double centre_determinant, const Trilinear& t,
                             const Eigen::Vector3d& xi) {
  Matrix6x9 b;
  for (int m = 0; m < 3; ++m)  // d(1-ξ²)/dξ = -2ξ in direction m alone
    set_strain(centre_determinant / t.determinant * -2.0 * xi[m] * centre_inverse.col(m), m, b);
  return b;
}

struct Parts {
  MatrixSolid uu = MatrixSolid::Zero();
  Eigen::Matrix<double, 24, 9> ua = Eigen::Matrix<double, 24, 9>::Zero();
  Eigen::Matrix<double, 9, 9> aa = Eigen::Matrix<double, 9, 9>::Zero();
};

/// Stiffness for unit E before the internal displacements are condensed.
Parts integrate(const SolidGeometry& geometry, double nu) {
  const Eigen::Matrix<double, 6, 6> d = elasticity(nu);
  const Trilinear centre = trilinear_at(geometry, Eigen::Vector3d::Zero());
  const Eigen::Matrix3d inverse = centre.jacobian.inverse();
  Parts parts;
  for (const GaussPoint& point : gauss_2()) {
    const Trilinear t = trilinear_at(geometry, point.xi);
    const Matrix6x24 b = strain_at(t);
    const Matrix6x9 g = internal_strain_at(inverse, centre.determinant, t, point.xi);
    const double w = point.weight * t.determinant;
    const Matrix6x24 db = w * d * b;
    const Matrix6x9 dg = w * d * g;
    parts.uu += transposed_product(b, db);
    parts.ua += transposed_product(db, g);
    parts.aa += transposed_product(g, dg);
  }
  return parts;
}

}  // namespace

SolidShape solid_shape(const SolidGeometry& geometry) {
  SolidShape shape{0.0, 0.0, 0};
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
  for (const GaussPoint& point : gauss_3()) {
    const double determinant = trilinear_at(geometry, point.xi).determinant;
    shape.volume_m3 += point.weight * determinant;
    if (determinant < least) least = determinant, where = point.xi;
  }
  double size2 = 0.0;
  for (const Eigen::Vector3d& x : geometry.node_m) size2 = std::max(size2, (x - geometry.node_m[0]).squaredNorm());
  if (std::abs(shape.volume_m3) < 1e-12 * size2 * std::sqrt(size2)) return {0.0, 0.0, 0};  // rounding of the coordinates
  shape.least_ratio = 8.0 * least / std::abs(shape.volume_m3);                             // a box has volume 8 det J
  double nearest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i) {
    const auto& c = kCorner[static_cast<std::size_t>(i)];
    const double along = where.dot(Eigen::Vector3d(c[0], c[1], c[2]));
    if (along > nearest) nearest = along, shape.least_corner = i;
  }
  return shape;
}

MatrixSolid solid_stiffness(const SolidGeometry& geometry, const SolidProperties& properties) {
  require_sound(geometry);
  const Parts p = integrate(geometry, properties.poisson_ratio);
  const MatrixSolid k = properties.youngs_modulus_Pa * (p.uu - p.ua * p.aa.ldlt().solve(p.ua.transpose()));
  return 0.5 * (k + k.transpose());
}

MatrixSolid solid_geometric_stiffness(const SolidGeometry& geometry, const SolidProperties& properties,
                                      const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  require_sound(geometry);
  const Parts p = integrate(geometry, properties.poisson_ratio);
  const Eigen::Matrix<double, 9, 1> internal = -p.aa.ldlt().solve(p.ua.transpose() * displacement);
  const Eigen::Matrix<double, 6, 6> d = properties.youngs_modulus_Pa * elasticity(properties.poisson_ratio);
  const Trilinear centre = trilinear_at(geometry, Eigen::Vector3d::Zero());
  const Eigen::Matrix3d inverse = centre.jacobian.inverse();
  Eigen::Matrix<double, 8, 8> slope = Eigen::Matrix<double, 8, 8>::Zero();
  for (const GaussPoint& point : gauss_2()) {
    const Trilinear t = trilinear_at(geometry, point.xi);
    const Eigen::Matrix<double, 6, 1> strain =
        strain_at(t) * displacement + internal_strain_at(inverse, centre.determinant, t, point.xi) * internal;
    const Matrix3x8 gradient = t.gradient();
    slope += point.weight * t.determinant * gradient.transpose() * stress_tensor(d * strain) * gradient;
  }
  return for_three(slope);
}

MatrixSolid solid_mass(const SolidGeometry& geometry, double density_kg_m3) {
  require_sound(geometry);
  Eigen::Matrix<double, 8, 8> scalar = Eigen::Matrix<double, 8, 8>::Zero();
  for (const GaussPoint& point : gauss_3()) {
    const Trilinear t = trilinear_at(geometry, point.xi);
    scalar += density_kg_m3 * point.weight * t.determinant * t.value * t.value.transpose();
  }
  return for_three(scalar);
}

MatrixSolid solid_mass_lumped(const SolidGeometry& geometry, double density_kg_m3) {
  const MatrixSolid consistent = solid_mass(geometry, density_kg_m3);
  return consistent.rowwise().sum().asDiagonal();
}

}  // namespace twindeck::fe
