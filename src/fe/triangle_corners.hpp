#pragma once

#include <Eigen/Core>
#include <array>

/// What membrane, plate and mass of the three-node shell share: its corners in its own plane and the gradients of linear
/// shapes.
namespace twindeck::fe::triangle {

using Corners = std::array<Eigen::Vector2d, 3>;  ///< [m], anticlockwise
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Area, positive for anticlockwise corners [m²].
[[nodiscard]] inline double area(const Corners& x) {
  const Eigen::Vector2d a = x[1] - x[0], b = x[2] - x[0];
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

/// d/dx, d/dy of the three area coordinates, one column each [1/m], (2 × 3).
[[nodiscard]] inline Eigen::Matrix<double, 2, 3> gradients(const Corners& x) {
  Eigen::Matrix<double, 2, 3> g;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d opposite = x[(i + 2) % 3] - x[(i + 1) % 3];
    g.col(static_cast<Eigen::Index>(i)) << -opposite.y(), opposite.x();
  }
  return g / (2.0 * area(x));
}

}  // namespace twindeck::fe::triangle
