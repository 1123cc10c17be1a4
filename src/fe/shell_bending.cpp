#include "fe/shell_bending.hpp"

#include <Eigen/Dense>

#include "fe/element_products.hpp"
#include "fe/shell_frame.hpp"

namespace twindeck::fe {

namespace {

using Matrix2x12 = Eigen::Matrix<double, 2, 12>;  // columns w rx ry of the four corners
using Matrix3x12 = Eigen::Matrix<double, 3, 12>;

/// Rotation of the normal β = (βx, βy), u = z βx, v = z βy, at the corner: βx = ry, βy = -rx.
Matrix2x12 corner_rotation(int i) {
  Matrix2x12 beta = Matrix2x12::Zero();
  beta(0, 3 * i + 2) = 1.0;
  beta(1, 3 * i + 1) = -1.0;
  return beta;
}

/// At the middle of side i-j (tangent s, length l) the normal component of β is linear along the side, and the tangential one
/// satisfies Kirchhoff, β_s = -dw/ds, for the cubic w of the side:  β_s = -3/(2l) (w_j - w_i) - ¼ (β_si + β_sj).
Matrix2x12 middle_rotation(const shell::Frame& frame, int i, int j) {
  const Eigen::Vector2d side = frame.corner_m[static_cast<std::size_t>(j)] - frame.corner_m[static_cast<std::size_t>(i)];
  const double length = side.norm();
  const Eigen::Vector2d s = side / length;
  const Matrix2x12 sum = corner_rotation(i) + corner_rotation(j);
  Eigen::Matrix<double, 1, 12> rise = Eigen::Matrix<double, 1, 12>::Zero();
  rise(3 * j) = 1.0;
  rise(3 * i) = -1.0;
  return 0.5 * sum - s * (1.5 / length * rise + 0.75 * s.transpose() * sum);
}

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

/// Unit E t³ (12 × 12).
Eigen::Matrix<double, 12, 12> bending(const shell::Frame& frame, double poisson_ratio) {
  std::array<Matrix2x12, 8> beta;
  for (int i = 0; i < 4; ++i) {
    beta[static_cast<std::size_t>(i)] = corner_rotation(i);
    beta[static_cast<std::size_t>(i + 4)] = middle_rotation(frame, i, (i + 1) % 4);
  }
  const Eigen::Matrix3d d = shell::plane_stress(poisson_ratio) / 12.0;
  Eigen::Matrix<double, 12, 12> k = Eigen::Matrix<double, 12, 12>::Zero();
  for (const Eigen::Vector2d& point : shell::gauss_2x2()) {
    const shell::Bilinear at = shell::bilinear_at(frame, point.x(), point.y());
    const Eigen::Matrix<double, 2, 8> gradient = at.inverse * serendipity_gradient(point.x(), point.y());
    Matrix3x12 curvature = Matrix3x12::Zero();
    for (int n = 0; n < 8; ++n) {
      const Matrix2x12& b = beta[static_cast<std::size_t>(n)];
      curvature.row(0) += gradient(0, n) * b.row(0);
      curvature.row(1) += gradient(1, n) * b.row(1);
      curvature.row(2) += gradient(1, n) * b.row(0) + gradient(0, n) * b.row(1);
    }
    k += quadratic_form(at.determinant, curvature, d);
  }
  return k;
}

}  // namespace

Matrix24 shell_bending_stiffness(const ShellGeometry& geometry, const ShellProperties& properties) {
  const shell::Frame frame = shell::frame_of(geometry);
  const Eigen::Matrix<double, 12, 12> plate = bending(frame, properties.poisson_ratio);
  Matrix24 local = Matrix24::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) local.block<3, 3>(6 * i + 2, 6 * j + 2) = plate.block<3, 3>(3 * i, 3 * j);
  const double t = properties.thickness_m;
  const double scale = properties.youngs_modulus_Pa * t * t * t * properties.bending_inertia_ratio;
  return congruence(shell::corner_displacements(frame), local, scale);
}

}  // namespace twindeck::fe
