// Oracles: energies of constant stress and of pure bending, the drilling rules' own energies, rigid motions.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>

#include "fe/shell_quad.hpp"
#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using Plane24 = Eigen::Matrix<double, 24, 1>;

const ShellProperties kSheet = {8.0, 0.25, 0.5, 1.0};  // E t = 4

ShellGeometry level_sheet(double length, double width) {
  return {{Eigen::Vector3d(0, 0, 0), {length, 0, 0}, {length, width, 0}, {0, width, 0}}};
}

ShellGeometry lopsided_sheet() { return {{Eigen::Vector3d(0, 0, 0), {3, 0.5, 0}, {2.5, 2, 0}, {-0.5, 1, 0}}}; }  // area 4.125

/// u, v, rz at the corners.
Plane24 in_plane(const ShellGeometry& g, const std::function<Eigen::Vector3d(double, double)>& at) {
  Plane24 u = Plane24::Zero();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d& x = g.node_m[static_cast<std::size_t>(i)];
    const Eigen::Vector3d value = at(x.x(), x.y());
    u[6 * i] = value.x(), u[6 * i + 1] = value.y(), u[6 * i + 5] = value.z();
  }
  return u;
}

// Oracle: constant strain: u'K u = E t A ε'D ε (ν = 0.25: 16/15, 4/15, 0.4), drilling rotations following.
TEST(ShellMembrane, ConstantStrainHasItsEnergy) {
  const double exx = 0.7, eyy = -0.3, uy = 0.5, vx = 1.1, shear = uy + vx;
  const double density = 16.0 / 15.0 * (exx * exx + eyy * eyy) + 8.0 / 15.0 * exx * eyy + 0.4 * shear * shear;
  const Plane24 u = in_plane(lopsided_sheet(), [&](double x, double y) {
    return Eigen::Vector3d(exx * x + uy * y, vx * x + eyy * y, 0.5 * (vx - uy));
  });
  for (const double factor : {0.0, 0.01, 10.0}) {
    const Matrix24 k = shell_membrane_stiffness(lopsided_sheet(), kSheet, DrillingRule::penalty, factor);
    EXPECT_NEAR(u.dot(k * u) / (4.0 * 4.125 * density), 1.0, 1e-12);
  }
}

// Oracle: pure bending of a rectangle: E t κ² a b³/12 with u = -κ x y, v = κ (x² + ν y²)/2 about its middle, rz = κ x. The
// incompatible modes make it exact (Taylor, Beresford and Wilson 1976).
TEST(ShellMembrane, PureBendingIsExact) {
  for (const double length : {0.2, 1.0, 10.0}) {
    const Plane24 u = in_plane(level_sheet(length, 2.0), [&](double px, double py) {
      const double x = px - 0.5 * length, y = py - 1.0;
      return Eigen::Vector3d(-x * y, 0.5 * (x * x + 0.25 * y * y), x);
    });
    const Matrix24 k = shell_membrane_stiffness(level_sheet(length, 2.0), kSheet, DrillingRule::penalty, 0.0);
    EXPECT_NEAR(u.dot(k * u) / (4.0 * length * 8.0 / 12.0), 1.0, 1e-10) << length;
  }
}

// Oracle: corners that turn by one while nothing moves: penalty: γ G t A with G = E/(2 (1 + ν)), γ = 1 by default. diagonal:
// factor E t A at each of four corners, 0.03 by default, and the same in a rigid turn, as the header says.
TEST(ShellMembrane, DrillingHasItsOwnEnergy) {
  const ShellGeometry g = lopsided_sheet();
  const Plane24 spin = in_plane(g, [](double, double) { return Eigen::Vector3d(0.0, 0.0, 1.0); });
  const Plane24 turn = in_plane(g, [](double x, double y) { return Eigen::Vector3d(-y, x, 1.0); });
  const auto energy = [&](const Plane24& u, DrillingRule rule, double factor) {
    return u.dot(shell_membrane_stiffness(g, kSheet, rule, factor) * u);
  };
  const double eta = 4.0 * 4.125;
  EXPECT_NEAR(energy(spin, DrillingRule::penalty, 0.0), eta / 2.5, 1e-12);
  EXPECT_NEAR(energy(spin, DrillingRule::penalty, 0.2), 0.2 * eta / 2.5, 1e-12);
  EXPECT_NEAR(energy(turn, DrillingRule::penalty, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(energy(spin, DrillingRule::diagonal, 0.0), 4.0 * 0.03 * eta, 1e-12);
  EXPECT_NEAR(energy(turn, DrillingRule::diagonal, 0.1), 4.0 * 0.1 * eta, 1e-12);
}

// Oracle: six rigid motions of a warped sheet in space store nothing; what is out of plane stores nothing when it is flat; rank
// 12 - 3 (properties).
TEST(ShellMembrane, RigidMotionsStoreNothing) {
  const ShellGeometry warped = {{Eigen::Vector3d(1, 1, 0.1), {3, 1.2, -0.2}, {3.1, 3, 0.4}, {1, 2.5, 0.9}}};
  const Matrix24 k = shell_membrane_stiffness(warped, kSheet, DrillingRule::penalty, 0.0);
  for (int d = 0; d < 6; ++d) EXPECT_LT((k * testing_mesh::rigid_motion_of(warped.node_m, d)).norm(), 1e-12 * k.norm()) << d;
  EXPECT_EQ(testing_mesh::shell_rank(k), 9);
  const Matrix24 flat = shell_membrane_stiffness(lopsided_sheet(), kSheet, DrillingRule::penalty, 0.0);
  for (int i = 0; i < 4; ++i) EXPECT_LT(flat.middleRows(6 * i + 2, 3).norm(), 1e-13);
}

// Oracle: linear in E and in t; the ratio of bending has no part in it.
TEST(ShellMembrane, ScalesWithModulusAndThickness) {
  const ShellProperties more = {3.0 * kSheet.youngs_modulus_Pa, 0.25, 2.0 * kSheet.thickness_m, 7.0};
  for (const DrillingRule rule : {DrillingRule::penalty, DrillingRule::diagonal}) {
    const Matrix24 k = shell_membrane_stiffness(lopsided_sheet(), kSheet, rule, 0.0);
    EXPECT_LT((shell_membrane_stiffness(lopsided_sheet(), more, rule, 0.0) - 6.0 * k).norm(), 1e-13 * k.norm());
  }
}

}  // namespace
}  // namespace twindeck::fe
