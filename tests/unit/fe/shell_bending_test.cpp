// Oracles: energies of constant curvature and of a cubic, rigid motions, a warped plate.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "fe/shell_quad.hpp"
#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using Plate24 = Eigen::Matrix<double, 24, 1>;

const ShellProperties kSlab = {12.0, 0.25, 2.0, 0.5};  // E t³/12 · ratio = 4

ShellGeometry lopsided_slab() { return {{Eigen::Vector3d(0, 0, 0), {3, 0.5, 0}, {2.5, 2, 0}, {-0.5, 1, 0}}}; }  // area 4.125

/// w = (x'C x)/2 with rx = dw/dy, ry = -dw/dx.
Plate24 bent(const ShellGeometry& g, const Eigen::Matrix2d& curvature) {
  Plate24 u = Plate24::Zero();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d x = g.node_m[static_cast<std::size_t>(i)].head<2>(), slope = curvature * x;
    u.segment<3>(6 * i + 2) << 0.5 * x.dot(slope), slope.y(), -slope.x();
  }
  return u;
}

// Oracle: Kirchhoff: A E t³/(12 (1 - ν²)) RMI (κx² + κy² + 2 ν κx κy + (1 - ν)/2 (2 κxy)²), ν = 0.25.
TEST(ShellBending, ConstantCurvatureHasItsEnergy) {
  Eigen::Matrix2d bend, twist;
  bend << 0.7, 0.0, 0.0, -0.4;
  twist << 0.0, 0.3, 0.3, 0.0;
  const double d = 4.125 * 4.0 / (1.0 - 0.0625);
  const Matrix24 k = shell_bending_stiffness(lopsided_slab(), kSlab);
  const Plate24 u = bent(lopsided_slab(), bend), v = bent(lopsided_slab(), twist);
  EXPECT_NEAR(u.dot(k * u) / (d * (0.49 + 0.16 - 0.5 * 0.28)), 1.0, 1e-12);
  EXPECT_NEAR(v.dot(k * v) / (d * 0.375 * 0.36), 1.0, 1e-12);
  EXPECT_NEAR(u.dot(k * v), 0.0, 1e-12);
}

// Oracle: a strip is a beam: w = x³ along a rectangle at ν = 0 has E t³/12 RMI b ∫ (6 x)² dx = 4 · 2 · 12 L³.
TEST(ShellBending, StripBendsAsABeam) {
  const double length = 3.0;
  const ShellGeometry strip = {{Eigen::Vector3d(0, 0, 0), {length, 0, 0}, {length, 2, 0}, {0, 2, 0}}};
  Plate24 u = Plate24::Zero();
  for (const int i : {1, 2}) u[6 * i + 2] = length * length * length, u[6 * i + 4] = -3.0 * length * length;
  const ShellProperties without = {12.0, 0.0, 2.0, 0.5};
  EXPECT_NEAR(u.dot(shell_bending_stiffness(strip, without) * u) / (4.0 * 2.0 * 12.0 * 27.0), 1.0, 1e-12);
}

// Oracle: six rigid motions of a warped plate store nothing, rank 12 - 3; flat, it resists nothing in its plane (properties).
TEST(ShellBending, RigidMotionsStoreNothing) {
  const ShellGeometry warped = {{Eigen::Vector3d(1, 1, 0.1), {3, 1.2, -0.2}, {3.1, 3, 0.4}, {1, 2.5, 0.9}}};
  const Matrix24 k = shell_bending_stiffness(warped, kSlab);
  for (int d = 0; d < 6; ++d) EXPECT_LT((k * testing_mesh::rigid_motion_of(warped.node_m, d)).norm(), 1e-12 * k.norm()) << d;
  EXPECT_EQ(testing_mesh::shell_rank(k), 9);
  const Matrix24 flat = shell_bending_stiffness(lopsided_slab(), kSlab);
  for (int i = 0; i < 4; ++i) EXPECT_LT(flat.middleRows(6 * i, 2).norm() + flat.row(6 * i + 5).norm(), 1e-12);
}

// Oracle: the plate that is turned in space has the turned matrix; E t³ RMI scales it.
TEST(ShellBending, TurnsAndScales) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -0.5, 0.3).normalized()).toRotationMatrix();
  ShellGeometry turned = lopsided_slab();
  Matrix24 t = Matrix24::Zero();
  for (int block = 0; block < 24; block += 3) t.block<3, 3>(block, block) = turn;
  for (Eigen::Vector3d& x : turned.node_m) x = turn * x;
  const Matrix24 k = shell_bending_stiffness(lopsided_slab(), kSlab);
  EXPECT_LT((shell_bending_stiffness(turned, kSlab) - t * k * t.transpose()).norm(), 1e-12 * k.norm());
  const ShellProperties more = {5.0 * 12.0, 0.25, 2.0 * 2.0, 3.0 * 0.5};
  EXPECT_LT((shell_bending_stiffness(lopsided_slab(), more) - 120.0 * k).norm(), 1e-12 * 120.0 * k.norm());
}

}  // namespace
}  // namespace twindeck::fe
