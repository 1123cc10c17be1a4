#include "fe/beam_frame.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.hpp"

namespace twindeck::fe {

namespace {

Eigen::Vector3d chord(const BeamGeometry& geometry) {
  return geometry.node_m[1] + geometry.offset_m[1] - geometry.node_m[0] - geometry.offset_m[0];
}

/// A length is zero when rounding of the coordinates could have made it.
double checked_length(const BeamGeometry& geometry) {
  const double length = chord(geometry).norm();
  const double size = geometry.node_m[0].norm() + geometry.node_m[1].norm();
  if (!(length > 1e-12 * size) || !std::isfinite(length)) {
    const Eigen::Vector3d& x = geometry.node_m[0];
    throw InputError({},
                     fmt::format("beam at ({:.6g}, {:.6g}, {:.6g}) m has length {:.3g} m, expected two distinct ends", x.x(),
                                 x.y(), x.z(), length),
                     "give the beam two nodes (with their offsets) at different places");
  }
  return length;
}

}  // namespace

double beam_length(const BeamGeometry& geometry) { return checked_length(geometry); }

Eigen::Matrix3d beam_axes(const BeamGeometry& geometry) {
  const Eigen::Vector3d x = chord(geometry) / checked_length(geometry);
  Eigen::Vector3d reference = geometry.orientation;
  if (reference.norm() == 0.0) {
    const bool vertical = std::hypot(x.x(), x.y()) < 1e-6;
    reference = vertical ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  }
  reference.normalize();
  Eigen::Vector3d z = reference - reference.dot(x) * x;
  if (!(z.norm() > 1e-9)) {
    const Eigen::Vector3d& node = geometry.node_m[0];
    throw InputError({},
                     fmt::format("orientation ({:.6g}, {:.6g}, {:.6g}) of the beam at ({:.6g}, {:.6g}, {:.6g}) m lies along "
                                 "its axis, expected a vector across it",
                                 reference.x(), reference.y(), reference.z(), node.x(), node.y(), node.z()),
                     "give an orientation that is not parallel to the beam, or 0 0 0 for the default");
  }
  z.normalize();
  Eigen::Matrix3d axes;
  axes.row(0) = x;
  axes.row(1) = z.cross(x);
  axes.row(2) = z;
  return axes;
}

namespace beam {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d s;
  s << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return s;
}

Matrix12 end_displacements(const BeamGeometry& geometry) {
  const Eigen::Matrix3d axes = beam_axes(geometry);
  Matrix12 t = Matrix12::Zero();
  for (int end = 0; end < 2; ++end) {
    t.block<3, 3>(6 * end, 6 * end) = axes;
    t.block<3, 3>(6 * end, 6 * end + 3) = -axes * cross_matrix(geometry.offset_m[static_cast<std::size_t>(end)]);
    t.block<3, 3>(6 * end + 3, 6 * end + 3) = axes;
  }
  return t;
}

Matrix2x12 deflection_of(int end) {
  Matrix2x12 b = Matrix2x12::Zero();
  b(0, 6 * end + 1) = 1.0;
  b(1, 6 * end + 2) = 1.0;
  return b;
}

Matrix2x12 slope_of(int end) {
  Matrix2x12 b = Matrix2x12::Zero();
  b(0, 6 * end + 5) = 1.0;
  b(1, 6 * end + 4) = -1.0;
  return b;
}

Shape shape_at(double xi, double length_m, const Eigen::Matrix2d& shear_parameter) {
  const Matrix2x12 w1 = deflection_of(0), w2 = deflection_of(1), psi1 = slope_of(0), psi2 = slope_of(1);
  const Matrix2x12 chord_slope = (w2 - w1) / length_m;
  const Matrix2x12 q = 0.5 * (psi1 + psi2) - chord_slope;
  const Eigen::Matrix2d bent = (Eigen::Matrix2d::Identity() + shear_parameter).inverse();
  const Matrix2x12 bent_q = bent * q;
  Shape shape;
  shape.deflection = (1.0 - xi) * w1 + xi * w2 + 0.5 * length_m * (xi - xi * xi) * (psi1 - psi2) +
                     length_m * (xi - 3.0 * xi * xi + 2.0 * xi * xi * xi) * bent_q;
  shape.deflection_slope = chord_slope + 0.5 * (1.0 - 2.0 * xi) * (psi1 - psi2) + (1.0 - 6.0 * xi + 6.0 * xi * xi) * bent_q;
  shape.section_slope = shape.deflection_slope - (bent_q - q);
  return shape;
}

std::array<GaussPoint, 4> gauss_points() {
  constexpr double a = 0.3399810435848563, b = 0.8611363115940526, wa = 0.6521451548625461, wb = 0.3478548451374538;
  return {{{0.5 * (1.0 - b), 0.5 * wb}, {0.5 * (1.0 - a), 0.5 * wa}, {0.5 * (1.0 + a), 0.5 * wa}, {0.5 * (1.0 + b), 0.5 * wb}}};
}

}  // namespace beam
}  // namespace twindeck::fe
