#pragma once

#include "fe/shell_quad.hpp"

/// The mean plane of the four-node shell and the bilinear map on this plane, and what three- and four-node shells share. The
/// membrane, bending and mass matrices all use them.
namespace twindeck::fe::shell {

/// Mean plane of a quadrilateral. It contains the mean of the nodes and is parallel to both diagonals. The distances of the
/// nodes from it are therefore `+h` and `-h` in turn. Local x goes from the midpoint of side 4-1 to the midpoint of side 2-3.
/// Local z is x13 × x24 / |x13 × x24|.
struct Frame {
  Eigen::Matrix3d axes;                     ///< rows local x, y, z in global axes
  std::array<Eigen::Vector2d, 4> corner_m;  ///< projected nodes, origin at their mean
  std::array<double, 4> height_m;           ///< signed distances of the nodes from the plane, along local z
};
/// @throws InputError for a quadrilateral that has no area or is not convex
[[nodiscard]] Frame frame_of(const ShellGeometry& geometry);

/// Transformation of global nodal displacements to local displacements (x y z rx ry rz) of the projected corners, (24 × 24). A
/// rigid link joins each node to its projected corner: u_corner = R (u_node + θ × (-h z)). A warped element can therefore move
/// as a rigid body without forces.
[[nodiscard]] Matrix24 corner_displacements(const Frame& frame);

/// Bilinear map at (ξ, η) ∈ [-1, 1]²; `jacobian` rows are d(x, y)/dξ and d(x, y)/dη.
struct Bilinear {
  Eigen::Vector4d value;
  Eigen::Matrix<double, 2, 4> gradient;  ///< d/dx, d/dy of the four functions [1/m]
  Eigen::Matrix2d jacobian, inverse;
  double determinant;
};
[[nodiscard]] Bilinear bilinear_at(const Frame& frame, double xi, double eta);

/// The 2 × 2 Gauss points (all weights 1).
[[nodiscard]] const std::array<Eigen::Vector2d, 4>& gauss_2x2();

/// Plane-stress matrix for unit E and thickness: stresses (xx, yy, xy) from strains (xx, yy, 2xy).
[[nodiscard]] Eigen::Matrix3d plane_stress(double poisson_ratio);

/// Signs of the corners: (ξ_i, η_i) = (-1,-1), (1,-1), (1,1), (-1,1).
inline constexpr std::array<double, 4> kXi = {-1.0, 1.0, 1.0, -1.0};
inline constexpr std::array<double, 4> kEta = {-1.0, -1.0, 1.0, 1.0};

template <int rows, int columns>
using Matrix = Eigen::Matrix<double, rows, columns>;

/// What a plate of n corners does along its sides 0-1, 1-2, … Columns w rx ry of the corners.
template <std::size_t n>
struct PlateSides {
  static constexpr int columns = 3 * static_cast<int>(n);
  /// Rotation of the normal, β = (βx, βy), u = z βx, v = z βy: at the corners, where βx = ry, βy = -rx, then in the middles.
  std::array<Matrix<2, columns>, 2 * n> beta;
  std::array<Matrix<1, columns>, n> shear;  ///< ∫ γ_s ds along the side [m], γ = ∇w + β constant along it
};

/// Discrete shear constraints. On side i-j (tangent s, length l) the component of β across is linear, the tangential one is
/// quadratic and γ_s constant; the side's equilibrium of bending, γ_s = (D_b / D_s) d²β_s/ds², and ∫ γ_s ds = w_j - w_i + ∫ β_s
/// ds give, with φ = shear_length2 / l² and g = (w_j - w_i) / l + ½ (β_si + β_sj),
///
///     β_s in the middle = ½ (β_si + β_sj) - 3/2 g / (1 + φ),     γ_s = g φ / (1 + φ).
///
/// φ = 0 is the discrete Kirchhoff side. Reference: Katili (1993), IJNME 36, 1859-1883 (DKMT) and 1885-1908 (DKMQ).
/// @param shear_length2_m2  ShellProperties::shear_length2_m2
template <std::size_t n>
[[nodiscard]] PlateSides<n> plate_sides(const std::array<Eigen::Vector2d, n>& corner_m, double shear_length2_m2) {
  constexpr int columns = PlateSides<n>::columns;
  PlateSides<n> sides;
  auto& beta = sides.beta;
  for (std::size_t i = 0; i < n; ++i) {
    const auto w = static_cast<Eigen::Index>(3 * i);
    beta[i].setZero();
    beta[i](0, w + 2) = 1.0;
    beta[i](1, w + 1) = -1.0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const Eigen::Vector2d side = corner_m[j] - corner_m[i];
    const double length = side.norm();
    const Eigen::Vector2d s = side / length;
    const Matrix<2, columns> sum = beta[i] + beta[j];
    Matrix<1, columns> rise = Matrix<1, columns>::Zero();
    rise(static_cast<Eigen::Index>(3 * j)) = 1.0;
    rise(static_cast<Eigen::Index>(3 * i)) = -1.0;
    const double square = length * length, both = square + shear_length2_m2;
    beta[n + i] = 0.5 * sum - square / both * s * (1.5 / length * rise + 0.75 * s.transpose() * sum);  // 1 / (1 + φ)
    sides.shear[i] = shear_length2_m2 / both * (rise + 0.5 * length * s.transpose() * sum);            // φ / (1 + φ)
  }
  return sides;
}

/// D_s for unit E t³: D_s = 12 D_b / shear_length2; 0 for a plate that is rigid in shear.
[[nodiscard]] inline double unit_shear(double poisson_ratio, double shear_length2_m2) {
  return shear_length2_m2 > 0.0 ? 1.0 / ((1.0 - poisson_ratio * poisson_ratio) * shear_length2_m2) : 0.0;
}

/// Curvatures xx, yy, 2xy where the functions of corners and middles have these gradients.
template <int columns, std::size_t functions>
[[nodiscard]] Matrix<3, columns> curvature_of(const std::array<Matrix<2, columns>, functions>& beta,
                                              const Matrix<2, static_cast<int>(functions)>& gradient) {
  Matrix<3, columns> curvature = Matrix<3, columns>::Zero();
  for (std::size_t n = 0; n < functions; ++n) {
    const auto slope = gradient.col(static_cast<Eigen::Index>(n));
    curvature.row(0) += slope.x() * beta[n].row(0);
    curvature.row(1) += slope.y() * beta[n].row(1);
    curvature.row(2) += slope.y() * beta[n].row(0) + slope.x() * beta[n].row(1);
  }
  return curvature;
}

/// A matrix over three of the six displacements of each corner, in their places among the six.
template <int size>
[[nodiscard]] Matrix<2 * size, 2 * size> placed(const Matrix<size, size>& flat, const std::array<int, 3>& places) {
  const auto at = [&](int i) { return 6 * (i / 3) + places[static_cast<std::size_t>(i % 3)]; };
  Matrix<2 * size, 2 * size> local = Matrix<2 * size, 2 * size>::Zero();
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) local(at(i), at(j)) = flat(i, j);
  return local;
}

/// A scalar matrix over the corners as that of translations (times `translation`) and of rotations about axes across the normal
/// (times `rotation`).
template <int n>
[[nodiscard]] Matrix<6 * n, 6 * n> at_corners(const Matrix<n, n>& scalar, double translation, double rotation = 0.0,
                                              const Eigen::Matrix3d& across = Eigen::Matrix3d::Zero()) {
  Matrix<6 * n, 6 * n> m = Matrix<6 * n, 6 * n>::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      m.template block<3, 3>(6 * i, 6 * j) = translation * scalar(i, j) * Eigen::Matrix3d::Identity();
      m.template block<3, 3>(6 * i + 3, 6 * j + 3) = rotation * scalar(i, j) * across;
    }
  return m;
}

}  // namespace twindeck::fe::shell
