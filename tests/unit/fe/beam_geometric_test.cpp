// Oracles: Przemieniecki's matrix, integrals of (dw/dx)² by hand, rigid turns.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "fe/bar.hpp"
#include "fe/beam.hpp"

namespace twindeck::fe {
namespace {

constexpr double kPull_N = 700.0, kSpan_m = 2.5;

BeamGeometry level_strut() {
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d(kSpan_m, 0.0, 0.0)};
  return g;
}

BeamGeometry inclined_strut() {
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d(1.0, -2.0, 0.5), Eigen::Vector3d(2.2, -0.9, 1.4)};
  g.orientation = Eigen::Vector3d(0.2, -0.3, 1.0);
  return g;
}

/// Displacements of a rigid turn by one radian about `axis` through the origin.
Vector12 rigid_turn(const BeamGeometry& g, const Eigen::Vector3d& axis) {
  Vector12 u;
  for (int i = 0; i < 2; ++i) {
    u.segment<3>(6 * i) = axis.cross(g.node_m[static_cast<std::size_t>(i)]);
    u.segment<3>(6 * i + 3) = axis;
  }
  return u;
}

// Oracle: Przemieniecki (1968), section 15.2: N/L [6/5, L/10, 2 L²/15, -L²/30]; slopes are rz, and -ry in the other plane.
TEST(BeamGeometric, IsThePublishedMatrix) {
  const Matrix12 k = beam_geometric_stiffness(level_strut(), kPull_N) / (kPull_N / kSpan_m);
  const double l = kSpan_m;
  Eigen::Matrix4d expected;
  expected << 1.2, 0.1 * l, -1.2, 0.1 * l, 0.1 * l, l * l / 7.5, -0.1 * l, -l * l / 30.0, -1.2, -0.1 * l, 1.2, -0.1 * l,
      0.1 * l, -l * l / 30.0, -0.1 * l, l * l / 7.5;
  const std::array<int, 4> horizontal = {1, 5, 7, 11}, vertical = {2, 4, 8, 10};
  const Eigen::Vector4d turned(1.0, -1.0, 1.0, -1.0);
  EXPECT_LT((Eigen::Matrix4d(k(horizontal, horizontal)) - expected).norm(), 1e-12);
  EXPECT_LT((Eigen::Matrix4d(turned.asDiagonal() * k(vertical, vertical) * turned.asDiagonal()) - expected).norm(), 1e-12);
  EXPECT_LT(k(horizontal, vertical).norm(), 1e-12);
  for (const int i : {0, 3, 6, 9}) EXPECT_EQ(k.row(i).norm(), 0.0) << i;  // neither along the axis nor twist
}

// Oracle: a rigid turn about an axis n stretches nothing; its work is N L |n × x|². Translations do none.
TEST(BeamGeometric, RigidTurnWorksWithTheForce) {
  BeamGeometry g = inclined_strut();
  const Eigen::Vector3d chord = g.node_m[1] - g.node_m[0];
  for (const bool with_offsets : {false, true}) {
    Eigen::Vector3d axis_chord = chord;
    if (with_offsets) {
      g.offset_m = {Eigen::Vector3d(0.1, 0.2, -0.3), Eigen::Vector3d(-0.2, 0.1, 0.25)};
      axis_chord += g.offset_m[1] - g.offset_m[0];
    }
    const Matrix12 k = beam_geometric_stiffness(g, kPull_N);
    EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(0.3, -0.5, 0.8)}) {
      const Vector12 u = rigid_turn(g, axis);
      const double expected = kPull_N / axis_chord.norm() * axis.cross(axis_chord).squaredNorm();
      EXPECT_NEAR(u.dot(k * u) / expected, 1.0, 1e-12);
    }
    Vector12 move = Vector12::Zero();
    move.segment<3>(0) = move.segment<3>(6) = Eigen::Vector3d(1.0, 2.0, 3.0);
    EXPECT_LT((k * move).norm(), 1e-12 * k.norm());
  }
}

// Oracle: pinned at both ends it is a string, N/L across its chord.
TEST(BeamGeometric, PinnedAtBothEndsIsAString) {
  BeamGeometry g = inclined_strut();
  g.releases = 1U << 4 | 1U << 5 | 1U << 10 | 1U << 11;
  const Matrix12 k = beam_geometric_stiffness(g, kPull_N);
  const Matrix6 string = string_stiffness(g.node_m, kPull_N);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      EXPECT_LT((k.block<3, 3>(6 * a, 6 * b) - string.block<3, 3>(3 * a, 3 * b)).norm(), 1e-12 * string.norm());
  EXPECT_LT(k.block(3, 0, 3, 12).norm() + k.block(9, 0, 3, 12).norm(), 1e-12 * k.norm());
}

// Oracle: hinge at end 2. w = (3 ξ² - ξ³)/2 for its deflection, L (ξ - 3 ξ²/2 + ξ³/2) for the turn of end 1; the integrals of
// their slopes squared are 6/5 1/L and L/5, of the product 1/5.
TEST(BeamGeometric, HingeAtOneEnd) {
  BeamGeometry g = level_strut();
  g.releases = 1U << 11;  // rz of end 2
  const Matrix12 k = beam_geometric_stiffness(g, kPull_N);
  EXPECT_NEAR(k(7, 7), 1.2 * kPull_N / kSpan_m, 1e-9);
  EXPECT_NEAR(k(5, 5), 0.2 * kPull_N * kSpan_m, 1e-9);
  EXPECT_NEAR(k(5, 7), -0.2 * kPull_N, 1e-9);
  EXPECT_NEAR(k(8, 10), 0.1 * kPull_N, 1e-9);  // the other plane keeps its slope
}

// Oracle: linear in the force, and the contract on length.
TEST(BeamGeometric, CompressionIsTensionWithTheOtherSign) {
  const Matrix12 k = beam_geometric_stiffness(inclined_strut(), kPull_N);
  EXPECT_LT((beam_geometric_stiffness(inclined_strut(), -2.0 * kPull_N) + 2.0 * k).norm(), 1e-12 * k.norm());
  EXPECT_EQ(beam_geometric_stiffness(inclined_strut(), 0.0).norm(), 0.0);
  BeamGeometry g = level_strut();
  g.node_m[1] = g.node_m[0];
  EXPECT_THROW((void)beam_geometric_stiffness(g, kPull_N), InputError);
}

}  // namespace
}  // namespace twindeck::fe
