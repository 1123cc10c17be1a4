#include "fe/shell_mass.hpp"

#include "fe/shell_frame.hpp"

namespace twindeck::fe {

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
  Matrix24 m = Matrix24::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      m.block<3, 3>(6 * i, 6 * j) = mass_per_area * products(i, j) * Eigen::Matrix3d::Identity();
      m.block<3, 3>(6 * i + 3, 6 * j + 3) = rotary_per_area * products(i, j) * in_plane;
    }
  }
  return m;
}

Matrix24 shell_mass_lumped(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area) {
  const Matrix24 consistent = shell_mass(geometry, mass_per_area, rotary_per_area);
  Matrix24 m = Matrix24::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (const int d : {0, 3}) m.block<3, 3>(6 * i + d, 6 * i + d) += consistent.block<3, 3>(6 * i + d, 6 * j + d);
  return m;
}

}  // namespace twindeck::fe
