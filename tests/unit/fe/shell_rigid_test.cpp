#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "shell_mesh.hpp"

namespace twindeck::fe {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

const ShellProperties kConcrete = {30e9, 0.2, 0.18, 0.7};

/// A distorted quadrilateral in a general plane; `warp` moves the corners alternately off the plane.
ShellGeometry tilted(double warp) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -0.5, 0.3).normalized()).toRotationMatrix();
  const std::array<Eigen::Vector3d, 4> flat = {Eigen::Vector3d(0.0, 0.0, warp), Eigen::Vector3d(1.3, 0.1, -warp),
                                               Eigen::Vector3d(1.1, 0.9, warp), Eigen::Vector3d(-0.2, 0.7, -warp)};
  ShellGeometry g;
  for (std::size_t i = 0; i < 4; ++i) g.node_m[i] = turn * flat[i] + Eigen::Vector3d(2.0, -1.0, 3.0);
  return g;
}

// Oracle: six rigid motions without energy, flat and warped; ranks: membrane 12 - 3, bending 12 - 3, together 24 - 6;
// symmetric, no negative eigenvalue (properties).
TEST(ShellRigid, SixMotionsWithoutEnergy) {
  for (const double warp : {0.0, 0.02}) {
    const ShellGeometry g = tilted(warp);
    const Matrix24 membrane = shell_membrane_stiffness(g, kConcrete, DrillingRule::penalty, 0.0);
    const Matrix24 bending = shell_bending_stiffness(g, kConcrete);
    for (int d = 0; d < 6; ++d) {
      EXPECT_NEAR((membrane * testing_mesh::rigid_motion_of(g.node_m, d)).norm() / membrane.norm(), 0.0, 1e-13)
          << "motion " << d << ", warp " << warp;
      EXPECT_NEAR((bending * testing_mesh::rigid_motion_of(g.node_m, d)).norm() / bending.norm(), 0.0, 1e-13)
          << "motion " << d << ", warp " << warp;
    }
    EXPECT_NEAR((membrane - membrane.transpose()).norm(), 0.0, 1e-6);
    EXPECT_EQ(testing_mesh::shell_rank(membrane), 9);
    EXPECT_EQ(testing_mesh::shell_rank(bending), 9);
    const double scale = membrane.norm() / bending.norm();
    EXPECT_EQ(testing_mesh::shell_rank(membrane + scale * bending), 18);
  }
}

// Oracle: the rule as stated: factor·E·t·A on each corner's rotation about the normal and nothing else; a rigid turn in the
// plane therefore costs 4 factor E t A, the other five motions nothing.
TEST(ShellRigid, DiagonalDrillingIsGroundedAndOtherMotionsAreFree) {
  const ShellGeometry g = tilted(0.0);
  const Matrix24 k = shell_membrane_stiffness(g, kConcrete, DrillingRule::diagonal, 0.0);
  const Eigen::Vector3d normal = (g.node_m[2] - g.node_m[0]).cross(g.node_m[3] - g.node_m[1]).normalized();
  for (int d = 0; d < 3; ++d) EXPECT_NEAR((k * testing_mesh::rigid_motion_of(g.node_m, d)).norm() / k.norm(), 0.0, 1e-13);
  const auto turn = [&](const Eigen::Vector3d& axis) {
    return Vector24(axis.x() * testing_mesh::rigid_motion_of(g.node_m, 3) +
                    axis.y() * testing_mesh::rigid_motion_of(g.node_m, 4) +
                    axis.z() * testing_mesh::rigid_motion_of(g.node_m, 5));
  };
  const double expected = 4.0 * 0.03 * kConcrete.youngs_modulus_Pa * kConcrete.thickness_m * shell_area(g);
  EXPECT_NEAR(turn(normal).dot(k * turn(normal)) / expected, 1.0, 1e-10);
  EXPECT_NEAR((k * turn(normal.unitOrthogonal())).norm() / k.norm(), 0.0, 1e-12);
}

// Oracle: linearity stated in the header: membrane in E t, bending in E t³ and its ratio, mass in both its densities.
TEST(ShellRigid, ScalesAsStated) {
  const ShellGeometry g = tilted(0.01);
  ShellProperties more = kConcrete;
  more.youngs_modulus_Pa *= 2.0;
  more.thickness_m *= 3.0;
  more.bending_inertia_ratio *= 5.0;
  const auto near = [](const Matrix24& a, const Matrix24& b) { return (a - b).norm() / b.norm() < 1e-13; };
  EXPECT_TRUE(near(shell_membrane_stiffness(g, more, DrillingRule::penalty, 0.0),
                   6.0 * shell_membrane_stiffness(g, kConcrete, DrillingRule::penalty, 0.0)));
  EXPECT_TRUE(near(shell_membrane_stiffness(g, more, DrillingRule::diagonal, 0.0),
                   6.0 * shell_membrane_stiffness(g, kConcrete, DrillingRule::diagonal, 0.0)));
  EXPECT_TRUE(near(shell_bending_stiffness(g, more), 270.0 * shell_bending_stiffness(g, kConcrete)));
  EXPECT_TRUE(near(shell_mass(g, 400.0, 3.0), 400.0 * shell_mass(g, 1.0, 0.0) + 3.0 * shell_mass(g, 0.0, 1.0)));
}

// Oracle: the element does not know where its numbering starts (property): shifted corners give the permuted matrix.
TEST(ShellRigid, NumberingDoesNotMatter) {
  const ShellGeometry g = tilted(0.01);
  ShellGeometry shifted;
  Eigen::PermutationMatrix<24> p;
  for (int i = 0; i < 4; ++i) {
    shifted.node_m[static_cast<std::size_t>(i)] = g.node_m[static_cast<std::size_t>((i + 1) % 4)];
    for (int d = 0; d < 6; ++d) p.indices()[6 * ((i + 1) % 4) + d] = 6 * i + d;
  }
  const auto same = [&p](const Matrix24& original, const Matrix24& moved) {
    const Matrix24 expected = p * original * p.transpose();
    EXPECT_NEAR((moved - expected).norm() / expected.norm(), 0.0, 1e-12);
  };
  same(shell_membrane_stiffness(g, kConcrete, DrillingRule::penalty, 0.0),
       shell_membrane_stiffness(shifted, kConcrete, DrillingRule::penalty, 0.0));
  same(shell_bending_stiffness(g, kConcrete), shell_bending_stiffness(shifted, kConcrete));
  same(shell_mass(g, 300.0, 1.0), shell_mass(shifted, 300.0, 1.0));
}

// Oracle: the contract on bad input.
TEST(ShellRigid, RefusesNoAreaAndReentrantCorners) {
  ShellGeometry g;
  g.node_m = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(3, 0, 0)};
  EXPECT_THROW((void)shell_bending_stiffness(g, kConcrete), InputError);
  g.node_m = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.2, 0.2, 0), Eigen::Vector3d(0, 1, 0)};
  EXPECT_THROW((void)shell_mass(g, 1.0, 0.0), InputError);
  g.node_m = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 0, 0),
              Eigen::Vector3d(0, 1, 0)};  // crossed
  EXPECT_THROW((void)shell_membrane_stiffness(g, kConcrete, DrillingRule::penalty, 0.0), InputError);
}

}  // namespace
}  // namespace twindeck::fe
