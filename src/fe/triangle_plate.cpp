#include "fe/triangle_plate.hpp"

#include <Eigen/Dense>

#include "fe/element_products.hpp"
#include "fe/shell_frame.hpp"

namespace twindeck::fe::triangle {

namespace {

using Matrix2x9 = Eigen::Matrix<double, 2, 9>;  // columns w rx ry of the three corners

/// Rotation of the normal β = (βx, βy), u = z βx, v = z βy, at a corner: βx = ry, βy = -rx.
Matrix2x9 normal_at_corner(int i) {
  Matrix2x9 beta = Matrix2x9::Zero();
  beta(0, 3 * i + 2) = 1.0;
  beta(1, 3 * i + 1) = -1.0;
  return beta;
}

/// At the middle of side i-j, as in the four-node plate:  β_s = -3/(2l) (w_j - w_i) - ¼ (β_si + β_sj),  β_n = ½ (β_ni + β_nj).
Matrix2x9 normal_at_middle(const Corners& x, int i, int j) {
  const Eigen::Vector2d side = x[static_cast<std::size_t>(j)] - x[static_cast<std::size_t>(i)];
  const double length = side.norm();
  const Eigen::Vector2d s = side / length;
  const Matrix2x9 sum = normal_at_corner(i) + normal_at_corner(j);
  Eigen::Matrix<double, 1, 9> rise = Eigen::Matrix<double, 1, 9>::Zero();
  rise(3 * j) = 1.0;
  rise(3 * i) = -1.0;
  return 0.5 * sum - s * (1.5 / length * rise + 0.75 * s.transpose() * sum);
}

}  // namespace

Matrix9 kirchhoff_plate(const Corners& corner_m, double poisson_ratio) {
  std::array<Matrix2x9, 6> beta;
  for (int i = 0; i < 3; ++i) {
    beta[static_cast<std::size_t>(i)] = normal_at_corner(i);
    beta[static_cast<std::size_t>(i + 3)] = normal_at_middle(corner_m, i, (i + 1) % 3);
  }
  const Eigen::Matrix<double, 2, 3> g = gradients(corner_m);
  const Eigen::Matrix3d d = shell::plane_stress(poisson_ratio) / 12.0;
  Matrix9 k = Matrix9::Zero();
  // Curvatures are linear, so the three middles of the sides, a third of the area each, integrate exactly.
  for (int point = 0; point < 3; ++point) {
    Eigen::Vector3d at = Eigen::Vector3d::Constant(0.5);  // area coordinates
    at[point] = 0.0;
    Eigen::Matrix<double, 3, 9> curvature = Eigen::Matrix<double, 3, 9>::Zero();
    for (int n = 0; n < 6; ++n) {
      const int i = n % 3, j = (i + 1) % 3;
      const Eigen::Vector2d slope = n < 3 ? Eigen::Vector2d((4.0 * at[i] - 1.0) * g.col(i))
                                          : Eigen::Vector2d(4.0 * (at[i] * g.col(j) + at[j] * g.col(i)));
      const Matrix2x9& b = beta[static_cast<std::size_t>(n)];
      curvature.row(0) += slope.x() * b.row(0);
      curvature.row(1) += slope.y() * b.row(1);
      curvature.row(2) += slope.y() * b.row(0) + slope.x() * b.row(1);
    }
    k += quadratic_form(area(corner_m) / 3.0, curvature, d);
  }
  return k;
}

}  // namespace twindeck::fe::triangle
