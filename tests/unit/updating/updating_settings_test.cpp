// Oracles: values set here, one unlike the other, so that an exchange shows; the logic of the words in the header.
#include "updating/updating_settings.hpp"

#include <gtest/gtest.h>

namespace twindeck::updating {
namespace {

TEST(UpdatingSettings, EachOptionTakesItsOwnValue) {
  UpdatingSettings settings;
  settings.trust_radius = 0.75;
  settings.starts = 3;
  settings.n_modes = 17;
  settings.max_iterations = 41;
  settings.outer_iterations = 5;
  settings.optimality_tolerance = 3e-5;
  settings.leave_one_out = true;
  const UpdatingOptions options = settings.options(99);
  EXPECT_DOUBLE_EQ(options.trust_radius, 0.75);
  EXPECT_EQ(options.starts, 3);
  EXPECT_EQ(options.n_modes, 17);
  EXPECT_EQ(options.max_iterations, 41);
  EXPECT_EQ(options.outer_iterations, 5);
  EXPECT_DOUBLE_EQ(options.optimality_tolerance, 3e-5);
  EXPECT_EQ(options.seed, 99U);
  EXPECT_TRUE(options.leave_one_out);
}

// Shapes have no relative residual, so they are always weighed; frequencies alone only on demand.
TEST(UpdatingSettings, RowsAreWeighedWithShapesOrOnDemand) {
  UpdatingSettings settings;
  EXPECT_FALSE(settings.weighs_shapes());
  EXPECT_FALSE(settings.weighs());
  settings.weights = "covariance";
  EXPECT_FALSE(settings.weighs_shapes());
  EXPECT_TRUE(settings.weighs());
  settings.weights = "automatic";
  settings.residuals = {"frequency", "shape"};
  EXPECT_TRUE(settings.weighs_shapes());
  EXPECT_TRUE(settings.weighs());
  settings.residuals.clear();
  EXPECT_FALSE(settings.weighs_shapes());
}

}  // namespace
}  // namespace twindeck::updating
