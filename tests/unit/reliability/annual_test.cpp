/// Oracles: straight lines and powers through given points.
#include <gtest/gtest.h>

#include <cmath>

#include "reliability/wind_law.hpp"

namespace twindeck::reliability {
namespace {

TEST(OverSpeed, ProbabilitiesAreStraightLinesFromCalmAir) {
  const OverSpeed curve{{10.0, 20.0}, {0.2, 0.6}};
  EXPECT_NEAR(curve.probability(0.0, 1.0), 0.0, 1e-15);
  EXPECT_NEAR(curve.probability(5.0, 1.0), 0.1, 1e-15);
  EXPECT_NEAR(curve.probability(15.0, 1.0), 0.4, 1e-15);
  EXPECT_NEAR(curve.probability(20.0, 1.0), 0.6, 1e-15);
  EXPECT_EQ(curve.probability(20.1, 1.0), 1.0);
}

TEST(OverSpeed, DamagesArePowersOfTheSpeed) {
  OverSpeed curve{{10.0, 20.0, 30.0}, {}};
  for (const double v : curve.speed_m_s) curve.value.push_back(3e-12 * std::pow(v, 7.0));
  for (const double v : {2.0, 10.0, 14.0, 25.0, 30.0, 44.0})
    EXPECT_NEAR(curve.damage(v) / (3e-12 * std::pow(v, 7.0)), 1.0, 1e-12) << v;
  EXPECT_EQ(curve.damage(0.0), 0.0);
  curve.value[0] = 0.0;
  EXPECT_EQ(curve.damage(12.0), 0.0);
}

}  // namespace
}  // namespace twindeck::reliability
