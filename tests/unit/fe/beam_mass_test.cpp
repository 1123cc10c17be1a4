// Oracles: published consistent masses, and the mass and the moments of inertia of a rigid rod.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "fe/beam.hpp"

namespace twindeck::fe {
namespace {

constexpr double kRho = 7850.0, kLong_m = 1.6;

BeamStiffnessProperties slim_section() { return {210e9, 81e9, 4.0e-3, 8.0e-6, 3.0e-6, 0.0, 5.0e-8, 0.0, 0.0}; }
BeamStiffnessProperties lopsided_section() { return {210e9, 81e9, 4.0e-3, 8.0e-6, 3.0e-6, 2.0e-6, 5.0e-8, 1.8e-3, 2.2e-3}; }

BeamGeometry rod_along_x() {
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d(kLong_m, 0.0, 0.0)};
  return g;
}

/// Turn by one radian about `axis` through the origin.
Vector12 turn_of_rod(const BeamGeometry& g, const Eigen::Vector3d& axis) {
  Vector12 u;
  for (int i = 0; i < 2; ++i) {
    u.segment<3>(6 * i) = axis.cross(g.node_m[static_cast<std::size_t>(i)]);
    u.segment<3>(6 * i + 3) = axis;
  }
  return u;
}

// Oracle: Przemieniecki (1968), section 11.4, rigid in shear: ρ A L/420 [156, 22 L, 4 L², 54, -13 L, -3 L²], and the rotary
// part ρ I/(30 L) [36, 3 L, 4 L², -36, 3 L, -L²]; rods along the axis 1/3 and 1/6.
TEST(BeamMass, IsThePublishedConsistentMass) {
  const BeamStiffnessProperties s = slim_section();
  const double l = kLong_m, unit = kRho * s.area_m2 * l / 420.0, tilt = kRho * s.inertia_z_m4 / (30.0 * l);
  const Matrix12 plain = beam_mass(rod_along_x(), s, kRho, false), rotary = beam_mass(rod_along_x(), s, kRho, true) - plain;
  Eigen::Matrix4d translation, rotation;
  translation << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l, -3 * l * l,
      -22 * l, 4 * l * l;
  rotation << 36, 3 * l, -36, 3 * l, 3 * l, 4 * l * l, -3 * l, -l * l, -36, -3 * l, 36, -3 * l, 3 * l, -l * l, -3 * l,
      4 * l * l;
  const std::array<int, 4> horizontal = {1, 5, 7, 11};
  EXPECT_LT((Eigen::Matrix4d(plain(horizontal, horizontal)) - unit * translation).norm(), 1e-12 * unit * 156);
  EXPECT_LT((Eigen::Matrix4d(rotary(horizontal, horizontal)) - tilt * rotation).norm(), 1e-11 * tilt * 36);
  EXPECT_NEAR(plain(0, 0), 140.0 * unit, 1e-9);
  EXPECT_NEAR(plain(0, 6), 70.0 * unit, 1e-9);
  EXPECT_NEAR(plain(3, 3), kRho * (s.inertia_y_m4 + s.inertia_z_m4) * l / 3.0, 1e-12);
  EXPECT_NEAR(plain(3, 9), kRho * (s.inertia_y_m4 + s.inertia_z_m4) * l / 6.0, 1e-12);
  EXPECT_NEAR(plain(2, 4), -22.0 * l * unit, 1e-9);  // an upward motion goes with -ry
}

// Oracle: Przemieniecki (1968), eq. 11.33, with shear: ρ A L (13/35 + 7 Φ/10 + Φ²/3)/(1 + Φ)² and ρ I/L 6/5/(1 + Φ)².
TEST(BeamMass, ShearChangesTheShapes) {
  BeamStiffnessProperties s = slim_section();
  s.shear_area_y_m2 = 2.0e-5;
  const double phi = 12.0 * s.youngs_modulus_Pa * s.inertia_z_m4 / (s.shear_modulus_Pa * s.shear_area_y_m2 * kLong_m * kLong_m);
  ASSERT_GT(phi, 0.5);
  const double total = kRho * s.area_m2 * kLong_m, once = 1.0 + phi;
  const Matrix12 plain = beam_mass(rod_along_x(), s, kRho, false), rotary = beam_mass(rod_along_x(), s, kRho, true) - plain;
  EXPECT_NEAR(plain(1, 1), total * (13.0 / 35.0 + 0.7 * phi + phi * phi / 3.0) / (once * once), 1e-10);
  EXPECT_NEAR(rotary(1, 1), kRho * s.inertia_z_m4 / kLong_m * 1.2 / (once * once), 1e-12);
  EXPECT_NEAR(plain(2, 2), total * 13.0 / 35.0, 1e-10);  // the other plane is rigid in shear
}

// Oracle: a rigid rod that turns about its end: ρ A L³/3 and the section's moments ρ L (a² Iy + b² Iz - 2 a b Iyz) across it,
// ρ L (Iy + Iz) along it. Lumped, the ends alone move: ρ A L/2 · L².
TEST(BeamMass, RigidTurnsHaveTheMomentsOfARod) {
  const BeamStiffnessProperties s = lopsided_section();
  const double l = kLong_m;
  for (const bool lumped : {false, true}) {
    const Matrix12 m = lumped ? beam_mass_lumped(rod_along_x(), s, kRho, true) : beam_mass(rod_along_x(), s, kRho, true);
    const double rod = kRho * s.area_m2 * l * l * l / (lumped ? 2.0 : 3.0);
    const Vector12 y = turn_of_rod(rod_along_x(), Eigen::Vector3d::UnitY()),
                   z = turn_of_rod(rod_along_x(), Eigen::Vector3d::UnitZ()),
                   x = turn_of_rod(rod_along_x(), Eigen::Vector3d::UnitX());
    EXPECT_NEAR(y.dot(m * y), rod + kRho * l * s.inertia_y_m4, 1e-10);
    EXPECT_NEAR(z.dot(m * z), rod + kRho * l * s.inertia_z_m4, 1e-10);
    EXPECT_NEAR(y.dot(m * z), -kRho * l * s.inertia_yz_m4, 1e-10);
    EXPECT_NEAR(x.dot(m * x), kRho * l * (s.inertia_y_m4 + s.inertia_z_m4), 1e-12);
    for (int d = 0; d < 3; ++d) {
      Vector12 move = Vector12::Zero();
      move[d] = move[6 + d] = 1.0;
      EXPECT_NEAR(move.dot(m * move), kRho * s.area_m2 * l, 1e-10);
    }
  }
}

// Oracle: Steiner: a rod at height h that turns about the axis of its nodes has ρ A L h² more, and its momentum lies across.
TEST(BeamMass, OffsetAddsSteinersPart) {
  const BeamStiffnessProperties s = lopsided_section();
  BeamGeometry g = rod_along_x();
  g.offset_m = {Eigen::Vector3d(0.0, 0.0, 0.3), Eigen::Vector3d(0.0, 0.0, 0.3)};
  const double total = kRho * s.area_m2 * kLong_m, polar = kRho * kLong_m * (s.inertia_y_m4 + s.inertia_z_m4);
  Vector12 across = Vector12::Zero();
  across[1] = across[7] = 1.0;
  for (const Matrix12& m : {beam_mass(g, s, kRho, true), beam_mass_lumped(g, s, kRho, true)}) {
    const Vector12 x = turn_of_rod(rod_along_x(), Eigen::Vector3d::UnitX());
    EXPECT_NEAR(x.dot(m * x), polar + 0.09 * total, 1e-10);
    EXPECT_NEAR(across.dot(m * x), -0.3 * total, 1e-10);
  }
}

// Oracle: half of the mass at each end, without rotary inertia no mass on the bending rotations; a beam of another direction is
// the turned beam.
TEST(BeamMass, LumpedMassStandsAtTheEnds) {
  const BeamStiffnessProperties s = lopsided_section();
  const Matrix12 m = beam_mass_lumped(rod_along_x(), s, kRho, false);
  Vector12 expected = Vector12::Zero();
  for (const int end : {0, 6}) {
    for (int d = 0; d < 3; ++d) expected[end + d] = 0.5 * kRho * s.area_m2 * kLong_m;
    expected[end + 3] = 0.5 * kRho * kLong_m * (s.inertia_y_m4 + s.inertia_z_m4);
  }
  EXPECT_LT((m - Matrix12(expected.asDiagonal())).norm(), 1e-12);
  BeamGeometry mast;
  mast.node_m = {Eigen::Vector3d(1.0, 1.0, 0.0), Eigen::Vector3d(1.0, 1.0, kLong_m)};  // local x y z = Z, -Y, X
  const Matrix12 up = beam_mass(mast, s, kRho, true), along = beam_mass(rod_along_x(), s, kRho, true);
  EXPECT_NEAR(up(0, 0), along(2, 2), 1e-10);
  EXPECT_NEAR(up(1, 1), along(1, 1), 1e-10);
  EXPECT_NEAR(up(2, 2), along(0, 0), 1e-10);
  EXPECT_NEAR(up(5, 5), along(3, 3), 1e-12);
  EXPECT_NEAR(up(0, 1), -along(2, 1), 1e-12);
}

// Oracle: the contract.
TEST(BeamMass, RefusesABeamWithoutLength) {
  BeamGeometry g = rod_along_x();
  g.node_m[1] = g.node_m[0];
  EXPECT_THROW((void)beam_mass(g, slim_section(), kRho, true), InputError);
  EXPECT_THROW((void)beam_mass_lumped(g, slim_section(), kRho, true), InputError);
}

}  // namespace
}  // namespace twindeck::fe
