// Oracles: lines by hand; a slope factor of two doubles lift above its value at zero angle and nothing else.
#include "aero/polar.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace {

using namespace twindeck;

aero::Polar table() {
  return {
      {-0.1, 0.0, 0.1}, {{0.3, 0.4, -0.01, 0, -5, 0.1}, {0.2, -0.1, 0.0, 0, -5, 0.1}, {0.3, -0.6, 0.01, 0, -5, 0.1}}, "table"};
}

TEST(Polar, LiesOnLinesBetweenItsRows) {
  const aero::StaticCoefficients c = table().at(0.025);
  EXPECT_NEAR(c.drag, 0.225, 1e-15);
  EXPECT_NEAR(c.lift, -0.225, 1e-15);
  EXPECT_NEAR(c.moment, 0.0025, 1e-15);
  EXPECT_NEAR(table().at(0.1).lift, -0.6, 1e-15);
  EXPECT_NEAR(table().at(-0.1).lift, 0.4, 1e-15);
}

TEST(Polar, RefusesAnglesBeyondItsRowsByTheirRange) {
  EXPECT_TRUE(table().covers(0.1) && table().covers(-0.1));
  EXPECT_FALSE(table().covers(0.11) || table().covers(-0.11));
  for (const double alpha : {-0.11, 0.11}) {
    try {
      const auto c = table().at(alpha);
      ADD_FAILURE() << c.lift;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("covers -5.72958 to 5.72958 degrees"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(aero::Polar({0.1, 0.1}, {{}, {}}, "twice"), InputError);
}

TEST(Polar, LiftSlopeFactorTurnsLiftAboutZeroAngle) {
  const aero::Polar turned = table().with_lift_slope_factor(2.0);
  const aero::StaticCoefficients before = table().at(0.06), after = turned.at(0.06), zero = turned.at(0.0);
  EXPECT_NEAR(zero.lift, -0.1, 1e-15);
  EXPECT_NEAR(after.lift + 0.1, 2.0 * (before.lift + 0.1), 1e-15);
  EXPECT_NEAR(after.lift_slope, -10.0, 1e-14);
  EXPECT_EQ(after.drag, before.drag);
  EXPECT_EQ(after.moment_slope, before.moment_slope);
}

}  // namespace
