// Oracles: angles in plan by hand; a turn of the whole plan changes nothing; the rise of the upwind edge in a rigid rotation;
// the same work by global forces and by drag, lift and moment.
#include "aero/strip.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace {

using namespace twindeck;

Eigen::Vector3d in_plan(double angle_deg) { return {std::cos(angle_deg * radians), std::sin(angle_deg * radians), 0.0}; }

// A strip of a deck along `deck_deg` in a wind that blows to `wind_deg`, both anticlockwise from X.
aero::Strip plan_strip(double deck_deg, double wind_deg) {
  return aero::make_strip("deck", 0, 0.0, 1.0, Eigen::Vector3d::Zero(), in_plan(deck_deg), {1.25, in_plan(wind_deg)});
}

// By hand: a deck along X, wind along Y; then a wind that is turned anticlockwise from the normal.
TEST(Strip, YawIsTheAngleFromTheNormalToTheWind) {
  EXPECT_NEAR(plan_strip(0, 90).yaw_rad, 0.0, 1e-15);
  EXPECT_NEAR(plan_strip(0, 120).yaw_rad, 30 * radians, 1e-15);
  EXPECT_NEAR(plan_strip(0, 50).yaw_rad, -40 * radians, 1e-15);
  EXPECT_NEAR(plan_strip(20, 90).yaw_rad, -20 * radians, 1e-15);
  EXPECT_NEAR((plan_strip(0, 120).normal - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-15);
}

// The lee side changes with the wind, and not with the sense in which the deck is numbered.
TEST(Strip, NormalPointsToTheLeeSideForEitherSenseOfTheDeck) {
  for (const double wind : {60.0, 90.0, 140.0}) {
    const aero::Strip there = plan_strip(0, wind), back = plan_strip(180, wind), other_wind = plan_strip(0, wind + 180);
    EXPECT_NEAR((there.normal - back.normal).norm(), 0.0, 1e-15);
    EXPECT_NEAR(there.yaw_rad, back.yaw_rad, 1e-15);
    EXPECT_NEAR((there.normal + other_wind.normal).norm(), 0.0, 1e-15);
    EXPECT_NEAR(there.yaw_rad, other_wind.yaw_rad, 1e-14);
  }
}

// Invariance: no direction of the plan is special.
TEST(Strip, ATurnOfThePlanTurnsTheNormalAndKeepsTheYaw) {
  const aero::Strip before = plan_strip(10, 75);
  for (const double turn : {37.0, 90.0, 200.0, 311.0}) {
    const aero::Strip after = plan_strip(10 + turn, 75 + turn);
    EXPECT_NEAR(after.yaw_rad, before.yaw_rad, 1e-14);
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn * radians, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_NEAR((after.normal - rotation * before.normal).norm(), 0.0, 1e-14);
  }
}

// The slope of the deck does not count: the strip is taken in plan.
TEST(Strip, SlopeOfTheDeckDoesNotTurnTheNormal) {
  const Eigen::Vector3d tangent(0.9, 0.3, 0.2), flat(0.9, 0.3, 0.0);
  const aero::Strip a = aero::make_strip("deck", 2, 7.0, 3.0, {1, 2, 3}, tangent, {}),
                    b = aero::make_strip("deck", 2, 7.0, 3.0, {1, 2, 3}, flat, {});
  EXPECT_NEAR((a.normal - b.normal).norm(), 0.0, 1e-15);
  EXPECT_NEAR(a.normal.norm(), 1.0, 1e-15);
  EXPECT_EQ(a.normal.z(), 0.0);
  EXPECT_EQ(a.section, 2);
  EXPECT_EQ(a.station_m, 7.0);
  EXPECT_EQ(a.length_m, 3.0);
  EXPECT_EQ(a.x_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(a.alpha_rad, 0.0);
}

TEST(Strip, WindAlongTheDeckIsRefused) {
  EXPECT_THROW(plan_strip(30, 30), InputError);
  EXPECT_THROW(plan_strip(30, 210), InputError);
  EXPECT_NO_THROW(plan_strip(30, 31));  // 89 degrees of yaw
}

// A rotation w moves the upwind edge, which is at -b y from the point, by w × (-b y). It rises by b alpha.
TEST(Strip, NoseUpRaisesTheUpwindEdge) {
  const aero::Strip strip = plan_strip(25, 70);
  const aero::Wind wind{1.25, in_plan(70)};
  const double b = 2.5;
  const Eigen::Vector3d w(0.3, -0.7, 0.9);
  for (const aero::ForceAxes axes : {aero::ForceAxes::deck, aero::ForceAxes::wind}) {
    const Eigen::Vector3d y = axes == aero::ForceAxes::deck ? strip.normal : wind.direction;
    const double rise = w.cross(-b * y).z();
    Eigen::Matrix<double, 6, 1> motion;
    motion << 0, 0, 0, w;
    const Eigen::Vector3d local = aero::kinematics(strip, axes, wind) * motion;
    EXPECT_NEAR(local(2) * b, rise, 1e-14);
    EXPECT_NEAR(local.head<2>().norm(), 0.0, 1e-15);  // a rotation does not move the point itself
  }
  EXPECT_NEAR(aero::nose_up(strip, w) * b, w.cross(-b * strip.normal).z(), 1e-14);
}

// By hand: displacements are read along the axes' y and upwards; rotations about the normal and the vertical are no pitch.
TEST(Strip, DisplacementsAreReadAlongTheAxes) {
  const aero::Strip strip = plan_strip(0, 120);
  const aero::Wind wind{1.25, in_plan(120)};
  Eigen::Matrix<double, 6, 1> motion;
  motion << 1.0, 2.0, 3.0, 0.0, 0.0, 0.0;
  const Eigen::Vector3d deck = aero::kinematics(strip, aero::ForceAxes::deck, wind) * motion;
  const Eigen::Vector3d along_wind = aero::kinematics(strip, aero::ForceAxes::wind, wind) * motion;
  EXPECT_NEAR((deck - Eigen::Vector3d(2.0, 3.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((along_wind - Eigen::Vector3d(-0.5 + std::sqrt(3.0), 3.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_EQ(aero::nose_up(strip, strip.normal), 0.0);
  EXPECT_EQ(aero::nose_up(strip, Eigen::Vector3d::UnitZ()), 0.0);
}

// Virtual work: the transposed matrix gives forces that work on global motions as drag, lift and moment on local ones. Drag is
// a force along y, lift a force upwards, the moment a couple about the horizontal axis e_z × y.
TEST(Strip, TransposeGivesTheGlobalForces) {
  const aero::Strip strip = plan_strip(-35, 100);
  const aero::Wind wind{1.25, in_plan(100)};
  for (const aero::ForceAxes axes : {aero::ForceAxes::deck, aero::ForceAxes::wind}) {
    const Eigen::Vector3d y = axes == aero::ForceAxes::deck ? strip.normal : wind.direction;
    const Eigen::Matrix<double, 6, 1> global = aero::kinematics(strip, axes, wind).transpose() * Eigen::Vector3d(3.0, 5.0, 7.0);
    EXPECT_NEAR((global.head<3>() - (3.0 * y + 5.0 * Eigen::Vector3d::UnitZ())).norm(), 0.0, 1e-14);
    EXPECT_NEAR((global.tail<3>() - 7.0 * Eigen::Vector3d(-y.y(), y.x(), 0.0)).norm(), 0.0, 1e-14);
  }
}

}  // namespace
