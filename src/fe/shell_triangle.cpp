#include "fe/shell_triangle.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "fe/element_products.hpp"
#include "fe/shell_frame.hpp"
#include "fe/triangle.hpp"

namespace twindeck::fe {

namespace {

constexpr double kLeastFlatness = 1e-10;  ///< [-] twice the area over the sum of the squared sides, as for four-node shells

struct TrianglePlane {
  Eigen::Matrix3d axes;  ///< rows local x (along side 1-2), y, z in global axes
  triangle::Corners corner_m;
};

TrianglePlane plane_of(const TriangleGeometry& geometry) {
  const auto& x = geometry.node_m;
  const Eigen::Vector3d side = x[1] - x[0], other = x[2] - x[0];
  const Eigen::Vector3d normal = side.cross(other);
  if (!(normal.norm() > kLeastFlatness * (side.squaredNorm() + other.squaredNorm() + (x[2] - x[1]).squaredNorm())))
    throw InputError({},
                     fmt::format("shell with first corner ({:.6g}, {:.6g}, {:.6g}) m has no area, expected a triangle",
                                 x[0].x(), x[0].y(), x[0].z()),
                     "give three distinct corners that do not lie on one line");
  TrianglePlane plane;
  plane.axes.row(0) = side.normalized();
  plane.axes.row(2) = normal.normalized();
  plane.axes.row(1) = plane.axes.row(2).cross(plane.axes.row(0));
  for (std::size_t i = 0; i < 3; ++i) plane.corner_m[i] = (plane.axes * (x[i] - x[0])).head<2>();
  return plane;
}

/// Puts three directions of each corner (of local x y z rx ry rz) in their places and turns them to global axes.
Matrix18 in_space(const TrianglePlane& plane, const triangle::Matrix9& flat, const std::array<int, 3>& directions) {
  Matrix18 turn = Matrix18::Zero();
  for (int block = 0; block < 18; block += 3) turn.block<3, 3>(block, block) = plane.axes;
  return congruence(turn, shell::placed(flat, directions));
}

/// Mass with the products of the corners' shapes, ∫ N_i N_j dA (3 × 3).
Matrix18 mass_of(const TrianglePlane& plane, const Eigen::Matrix3d& products, double mass_per_area, double rotary_per_area) {
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - plane.axes.row(2).transpose() * plane.axes.row(2);
  return shell::at_corners(products, mass_per_area, rotary_per_area, across);
}

}  // namespace

Matrix18 triangle_membrane_stiffness(const TriangleGeometry& geometry, const ShellProperties& properties) {
  const TrianglePlane plane = plane_of(geometry);
  const double scale = properties.youngs_modulus_Pa * properties.thickness_m;
  const triangle::Matrix9 flat = triangle::optimal_membrane(plane.corner_m, properties.poisson_ratio, geometry.straight_sides);
  return in_space(plane, scale * flat, {0, 1, 5});
}

Matrix18 triangle_bending_stiffness(const TriangleGeometry& geometry, const ShellProperties& properties) {
  const TrianglePlane plane = plane_of(geometry);
  const double t = properties.thickness_m;
  const double scale = properties.youngs_modulus_Pa * t * t * t * properties.bending_inertia_ratio;
  const auto flat = triangle::plate_bending(plane.corner_m, properties.poisson_ratio, properties.shear_length2_m2());
  return in_space(plane, scale * flat, {2, 3, 4});
}

Matrix18 triangle_geometric_stiffness(const TriangleGeometry& geometry, const ShellProperties& properties,
                                      const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  const TrianglePlane plane = plane_of(geometry);
  Eigen::Matrix<double, 9, 1> flat;
  for (int i = 0; i < 3; ++i) {
    flat.segment<2>(3 * i) = (plane.axes * displacement.segment<3>(6 * i)).head<2>();
    flat[3 * i + 2] = plane.axes.row(2).dot(displacement.segment<3>(6 * i + 3));
  }
  const Eigen::Vector3d n = properties.youngs_modulus_Pa * properties.thickness_m *
                            shell::plane_stress(properties.poisson_ratio) *
                            (triangle::mean_strain(plane.corner_m, geometry.straight_sides) * flat);
  Eigen::Matrix2d force;
  force << n[0], n[2], n[2], n[1];
  const Eigen::Matrix<double, 2, 3> gradient = triangle::gradients(plane.corner_m);
  const Eigen::Matrix3d slope = triangle::area(plane.corner_m) * gradient.transpose() * force * gradient;
  return shell::at_corners(slope, 1.0);
}

Matrix18 triangle_mass(const TriangleGeometry& geometry, double mass_per_area, double rotary_per_area) {
  const TrianglePlane plane = plane_of(geometry);
  const Eigen::Matrix3d ones = Eigen::Matrix3d::Ones(), unit = Eigen::Matrix3d::Identity();
  return mass_of(plane, triangle::area(plane.corner_m) / 12.0 * (ones + unit), mass_per_area, rotary_per_area);
}

Matrix18 triangle_mass_lumped(const TriangleGeometry& geometry, double mass_per_area, double rotary_per_area) {
  const TrianglePlane plane = plane_of(geometry);
  const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
  return mass_of(plane, triangle::area(plane.corner_m) / 3.0 * unit, mass_per_area, rotary_per_area);
}

}  // namespace twindeck::fe
