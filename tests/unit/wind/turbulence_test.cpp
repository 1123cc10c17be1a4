// Oracles: EN 1991-1-4 (4.7) and (B.1) by hand.
#include "wind/turbulence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::wind {
namespace {

/// Category II of EN 1991-1-4: z0 = 0.05 m, z_min = 2 m, kappa = 0.67 + 0.05 ln 0.05 = 0.52.
TurbulenceSet category_two() {
  TurbulenceSet set;
  set.roughness_m = 0.05;
  set.minimum_height_m = 2.0;
  set.kappa = 0.67 + 0.05 * std::log(0.05);
  set.sigma_ratio = {1.0, 0.75, 0.5};
  set.scale_ratio = {1.0, 0.25, 0.1};
  return set;
}

// Oracle: I(10 m) = 1/ln(200) = 0.18874, in a wind of 25 m/s: 4.7185 m/s.
TEST(Turbulence, IntensityIsTheCodes) {
  const TurbulenceSet set = category_two();
  EXPECT_NEAR(standard_deviation(set, Component::along, 10.0, 25.0), 4.7185, 5e-5);
  EXPECT_DOUBLE_EQ(standard_deviation(set, Component::across, 10.0, 25.0), 0.75 * 25.0 / std::log(200.0));
  EXPECT_DOUBLE_EQ(standard_deviation(set, Component::vertical, 10.0, 25.0), 0.5 * 25.0 / std::log(200.0));
  EXPECT_EQ(standard_deviation(set, Component::along, 10.0, 0.0), 0.0);
}

// Oracle: 300 m at 200 m; at 50 m 300/4^kappa, kappa = 0.520213.
TEST(Turbulence, LengthScaleIsTheCodes) {
  const TurbulenceSet set = category_two();
  EXPECT_DOUBLE_EQ(length_scale(set, Component::along, 200.0), 300.0);
  EXPECT_NEAR(length_scale(set, Component::along, 50.0), 300.0 / std::pow(4.0, 0.520213), 1e-3);
  EXPECT_DOUBLE_EQ(length_scale(set, Component::across, 200.0), 75.0);
  EXPECT_DOUBLE_EQ(length_scale(set, Component::vertical, 200.0), 30.0);
}

// Oracle: the header: constant below z_min, the ground and below it included.
TEST(Turbulence, ProfileIsConstantBelowTheLeastHeight) {
  const TurbulenceSet set = category_two();
  for (const double z : {1.9, 0.0, -5.0}) {
    EXPECT_DOUBLE_EQ(standard_deviation(set, Component::along, z, 25.0), 25.0 / std::log(40.0)) << z;
    EXPECT_DOUBLE_EQ(length_scale(set, Component::along, z), 300.0 * std::pow(0.01, set.kappa)) << z;
  }
  EXPECT_LT(standard_deviation(set, Component::along, 2.1, 25.0), 25.0 / std::log(40.0));
}

}  // namespace
}  // namespace twindeck::wind
