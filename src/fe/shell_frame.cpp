#include "fe/shell_frame.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.hpp"

namespace twindeck::fe {

namespace shell {

namespace {

double cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Frame frame_of(const ShellGeometry& geometry) {
  const auto& x = geometry.node_m;
  const Eigen::Vector3d d13 = x[2] - x[0], d24 = x[3] - x[1];
  const Eigen::Vector3d normal = d13.cross(d24);
  const double size2 = d13.squaredNorm() + d24.squaredNorm();
  const auto refuse = [&x](const char* problem) {
    throw InputError(
        {}, fmt::format("shell with first corner ({:.6g}, {:.6g}, {:.6g}) m {}", x[0].x(), x[0].y(), x[0].z(), problem),
        "give four distinct corners in order around the quadrilateral, each inner angle below 180 degrees");
  };
  if (!(normal.norm() > 1e-10 * size2)) refuse("has no area, expected a quadrilateral");
  Frame frame;
  const Eigen::Vector3d ez = normal.normalized();
  const Eigen::Vector3d ex = (d13 - d24).normalized();  // both diagonals lie in the plane, so this does too
  frame.axes.row(0) = ex;
  frame.axes.row(1) = ez.cross(ex);
  frame.axes.row(2) = ez;
  const Eigen::Vector3d centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d local = frame.axes * (x[i] - centre);
    frame.corner_m[i] = local.head<2>();
    frame.height_m[i] = local.z();
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& a = frame.corner_m[i];
    const Eigen::Vector2d& b = frame.corner_m[(i + 1) % 4];
    const Eigen::Vector2d& c = frame.corner_m[(i + 2) % 4];
    if (!(cross2(b - a, c - b) > 1e-10 * size2)) refuse("is not convex, expected inner angles below 180 degrees");
  }
  return frame;
}

Matrix24 corner_displacements(const Frame& frame) {
  Matrix24 t = Matrix24::Zero();
  for (int i = 0; i < 4; ++i) {
    const double h = frame.height_m[static_cast<std::size_t>(i)];
    t.block<3, 3>(6 * i, 6 * i) = frame.axes;
    t.block<3, 3>(6 * i + 3, 6 * i + 3) = frame.axes;
    // θ × (-h z) = (-h θy, h θx, 0) in local axes.
    t.block<1, 3>(6 * i, 6 * i + 3) = -h * frame.axes.row(1);
    t.block<1, 3>(6 * i + 1, 6 * i + 3) = h * frame.axes.row(0);
  }
  return t;
}

Bilinear bilinear_at(const Frame& frame, double xi, double eta) {
  Bilinear b;
  Eigen::Matrix<double, 2, 4> natural;
  b.jacobian.setZero();
  for (int i = 0; i < 4; ++i) {
    const auto s = static_cast<std::size_t>(i);
    b.value[i] = 0.25 * (1.0 + kXi[s] * xi) * (1.0 + kEta[s] * eta);
    natural(0, i) = 0.25 * kXi[s] * (1.0 + kEta[s] * eta);
    natural(1, i) = 0.25 * kEta[s] * (1.0 + kXi[s] * xi);
    b.jacobian += natural.col(i) * frame.corner_m[s].transpose();
  }
  b.determinant = b.jacobian.determinant();
  b.inverse = b.jacobian.inverse();
  b.gradient = b.inverse * natural;
  return b;
}

const std::array<Eigen::Vector2d, 4>& gauss_2x2() {
  static const double a = 1.0 / std::sqrt(3.0);
  static const std::array<Eigen::Vector2d, 4> points = {Eigen::Vector2d(-a, -a), Eigen::Vector2d(a, -a), Eigen::Vector2d(a, a),
                                                        Eigen::Vector2d(-a, a)};
  return points;
}

Eigen::Matrix3d plane_stress(double poisson_ratio) {
  Eigen::Matrix3d d;
  d << 1.0, poisson_ratio, 0.0, poisson_ratio, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - poisson_ratio);
  return d / (1.0 - poisson_ratio * poisson_ratio);
}

}  // namespace shell
}  // namespace twindeck::fe
