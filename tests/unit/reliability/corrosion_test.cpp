/// Oracle: the formula of ISO 9224 worked by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "reliability/worn_model.hpp"

namespace twindeck::reliability {
namespace {

TEST(Corrosion, IsAPowerToTwentyYearsAndALineAfter) {
  Corrosion steel;
  steel.first_year_m = 50e-6;
  EXPECT_NEAR(steel.loss_m(1.0), 50e-6, 1e-18);
  EXPECT_NEAR(steel.loss_m(20.0), 50e-6 * std::pow(20.0, 0.523), 1e-15);
  const double slope = 50e-6 * 0.523 * std::pow(20.0, -0.477);
  EXPECT_NEAR(steel.loss_m(50.0), steel.loss_m(20.0) + 30.0 * slope, 1e-15);
  EXPECT_NEAR(steel.loss_m(100.0), steel.loss_m(20.0) + 80.0 * slope, 1e-15);
  EXPECT_NEAR((steel.loss_m(20.0 + 1e-6) - steel.loss_m(20.0)) / 1e-6 / slope, 1.0, 1e-6);
  steel.coating_life_years = 15.0;
  EXPECT_EQ(steel.loss_m(10.0), 0.0);
  EXPECT_NEAR(steel.loss_m(16.0), 50e-6, 1e-18);
  for (const double years : {16.0, 35.0, 80.0}) EXPECT_NEAR(steel.years_until(steel.loss_m(years)), years, 1e-9);
}

TEST(Corrosion, AWallEatenThroughIsRefused) {
  EXPECT_NEAR(remaining_share(8e-3, 1e-3, 2), 0.75, 1e-15);
  EXPECT_NEAR(remaining_round_share(0.02, 1e-3), 0.81, 1e-15);
  EXPECT_THROW((void)remaining_share(2e-3, 1e-3, 2), InputError);
  EXPECT_THROW((void)remaining_round_share(2e-3, 1e-3), InputError);
}

}  // namespace
}  // namespace twindeck::reliability
