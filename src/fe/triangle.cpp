#include "fe/triangle.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "fe/element_products.hpp"
#include "fe/shell_frame.hpp"

namespace twindeck::fe::triangle {

namespace {

constexpr double kAlpha = 1.5;           ///< [-] bending of a side by the rotations of its ends (OPT)
constexpr double kLeastBetaZero = 0.01;  ///< [-] so that the rank stays 6 as ν approaches ½ (Felippa 2003)

/// Forces of the corners (rows u, v, rz) that stand for unit constant stresses xx, yy, xy (9 × 3).
Eigen::Matrix<double, 9, 3> corner_forces(const Corners& x, std::uint8_t straight_sides) {
  const auto alpha = [straight_sides](int side) { return (straight_sides >> side & 1U) != 0 ? 0.0 : kAlpha; };
  Eigen::Matrix<double, 9, 3> force;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d &at = x[static_cast<std::size_t>(i)], &next = x[static_cast<std::size_t>((i + 1) % 3)],
                          &last = x[static_cast<std::size_t>((i + 2) % 3)];
    const Eigen::Vector2d to_next = next - at, from_last = at - last, opposite = last - next;
    force.row(3 * i) << -opposite.y(), 0.0, opposite.x();
    force.row(3 * i + 1) << 0.0, opposite.x(), -opposite.y();
    const double last_side = alpha((i + 2) % 3) / 6.0, next_side = alpha(i) / 6.0;
    force.row(3 * i + 2) << last_side * from_last.y() * from_last.y() - next_side * to_next.y() * to_next.y(),
        last_side * from_last.x() * from_last.x() - next_side * to_next.x() * to_next.x(),
        2.0 * (next_side * to_next.x() * to_next.y() - last_side * from_last.x() * from_last.y());
  }
  return 0.5 * force;
}

/// Rotations of the corners less the mean rotation ½ (dv/dx - du/dy) of the triangle (3 × 9).
Eigen::Matrix<double, 3, 9> deviating_rotations(const Corners& x) {
  const Eigen::Matrix<double, 2, 3> g = gradients(x);
  Eigen::Matrix<double, 3, 9> deviation;
  for (int j = 0; j < 3; ++j) {
    deviation.col(3 * j).setConstant(0.5 * g(1, j));
    deviation.col(3 * j + 1).setConstant(-0.5 * g(0, j));
    deviation.col(3 * j + 2) = Eigen::Vector3d::Unit(j);
  }
  return deviation;
}

/// Stiffness of the deviating rotations (3 × 3).
Eigen::Matrix3d rotation_stiffness(const Corners& x, const Eigen::Matrix3d& d) {
  Eigen::Matrix3d along;  // strains along the sides 1-2, 2-3, 3-1 from xx, yy, 2xy
  Eigen::Vector3d inverse_square;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d side = x[static_cast<std::size_t>((i + 1) % 3)] - x[static_cast<std::size_t>(i)];
    inverse_square[i] = 1.0 / side.squaredNorm();
    along.row(i) << side.x() * side.x(), side.y() * side.y(), side.x() * side.y();
    along.row(i) *= inverse_square[i];
  }
  const Eigen::Matrix3d to_plane = along.inverse();
  const Eigen::Matrix3d natural = to_plane.transpose() * d * to_plane;
  // Felippa's β1 … β9 of OPT: 1, 2, 1, 0, 1, -1, -1, -1, -2. At corner 1, and by turning the numbers at corners 2 and 3.
  Eigen::Matrix3d at_corner;
  at_corner << 1.0, 2.0, 1.0, 0.0, 1.0, -1.0, -1.0, -1.0, -2.0;
  std::array<Eigen::Matrix3d, 3> strain;
  for (int corner = 0; corner < 3; ++corner)
    for (int side = 0; side < 3; ++side)
      for (int j = 0; j < 3; ++j)
        strain[static_cast<std::size_t>(corner)](side, j) =
            2.0 / 3.0 * area(x) * inverse_square[side] * at_corner((side + 3 - corner) % 3, (j + 3 - corner) % 3);
  Eigen::Matrix3d k = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Matrix3d middle = 0.5 * (strain[i] + strain[(i + 1) % 3]);
    k += middle.transpose() * natural * middle;
  }
  return k;
}

}  // namespace

Matrix9 optimal_membrane(const Corners& corner_m, double poisson_ratio, std::uint8_t straight_sides) {
  const Eigen::Matrix3d d = shell::plane_stress(poisson_ratio);
  const Eigen::Matrix<double, 9, 3> force = corner_forces(corner_m, straight_sides);
  const Eigen::Matrix<double, 3, 9> deviation = deviating_rotations(corner_m);
  const double beta_zero = std::max(0.5 * (1.0 - 4.0 * poisson_ratio * poisson_ratio), kLeastBetaZero);
  const double a = area(corner_m);
  return force * d * force.transpose() / a + quadratic_form(0.75 * beta_zero * a, deviation, rotation_stiffness(corner_m, d));
}

Eigen::Matrix<double, 3, 9> mean_strain(const Corners& corner_m, std::uint8_t straight_sides) {
  return corner_forces(corner_m, straight_sides).transpose() / area(corner_m);
}

Matrix9 plate_bending(const Corners& corner_m, double poisson_ratio, double shear_length2_m2) {
  const auto sides = shell::plate_sides(corner_m, shear_length2_m2);
  const Eigen::Matrix<double, 2, 3> g = gradients(corner_m);
  const Eigen::Matrix3d d = shell::plane_stress(poisson_ratio) / 12.0;
  const double shear = shell::unit_shear(poisson_ratio, shear_length2_m2);
  Matrix9 k = Matrix9::Zero();
  // Curvatures and shear strains are linear, so the three middles of the sides, a third of the area each, integrate exactly.
  for (int point = 0; point < 3; ++point) {
    Eigen::Vector3d at = Eigen::Vector3d::Constant(0.5);  // area coordinates
    at[point] = 0.0;
    Eigen::Matrix<double, 2, 6> slope;
    Eigen::Matrix<double, 2, 9> strain = Eigen::Matrix<double, 2, 9>::Zero();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      slope.col(i) = (4.0 * at[i] - 1.0) * g.col(i);
      slope.col(3 + i) = 4.0 * (at[i] * g.col(j) + at[j] * g.col(i));
      strain += (at[i] * g.col(j) - at[j] * g.col(i)) * sides.shear[static_cast<std::size_t>(i)];
    }
    k += quadratic_form(area(corner_m) / 3.0, shell::curvature_of(sides.beta, slope), d);
    if (shear > 0.0) k += shear * area(corner_m) / 3.0 * strain.transpose() * strain;
  }
  return k;
}

}  // namespace twindeck::fe::triangle
