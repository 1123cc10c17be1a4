// Oracles: directions and angles by hand; the paper's Table 14, one rule within an angle and another beyond it.
#include "aero/wind_settings.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"

namespace {

using namespace twindeck;

// Anticlockwise from +X: 90 degrees is +Y, 180 is -X.
TEST(WindSettings, DirectionIsAnticlockwiseFromX) {
  aero::WindSettings settings;
  settings.density_kg_m3 = 1.2;
  EXPECT_LT((settings.wind().direction - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(settings.wind().density_kg_m3, 1.2);
  settings.direction_deg = 180.0;
  EXPECT_LT((settings.wind().direction + Eigen::Vector3d::UnitX()).norm(), 1e-15);
  settings.direction_deg = -30.0;
  EXPECT_LT((settings.wind().direction - Eigen::Vector3d(std::sqrt(3.0) / 2, -0.5, 0)).norm(), 1e-15);
}

TEST(WindSettings, NamesAreThoseGivenAndEquationsConsistent) {
  aero::WindSettings settings;
  settings.decks.resize(2);
  settings.decks[0].name = "foot";
  settings.decks[1].name = "cycle";
  EXPECT_EQ(settings.deck_names(), (std::vector<std::string>{"foot", "cycle"}));
  EXPECT_EQ(settings.equations, aero::Equations::consistent);
}

// The models in their order, H_oblique among them, and no hybrid without zones.
TEST(WindSettings, DeploymentsAreTheModelsInOrder) {
  aero::WindSettings settings;
  settings.models = {"I", "H_oblique", "A"};
  const auto list = settings.deployments();
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].name, "I");
  EXPECT_EQ(list[1].name, "H_oblique");
  EXPECT_EQ(list[1].everywhere.inverse_power(2, 2), 3);
  EXPECT_EQ(list[2].name, "A");
  for (const aero::Deployment& deployment : list) EXPECT_TRUE(deployment.zones.empty());
  settings.models = {"A", "B"};
  EXPECT_THROW(static_cast<void>(settings.deployments()), InputError);
}

// Zones are given in degrees and compared with a yaw in radians.
TEST(WindSettings, HybridTakesTheOuterRuleBeyondItsAngle) {
  aero::WindSettings settings;
  settings.models = {"C"};
  settings.hybrid_inner = "H";
  settings.hybrid_outer = "G";
  settings.hybrid = {{"foot", 25.0}, {"cycle", 40.0}};
  const auto list = settings.deployments();
  ASSERT_EQ(list.size(), 2U);
  const aero::Deployment& mixed = list.back();
  EXPECT_EQ(mixed.name, "hybrid");
  EXPECT_EQ(mixed.at("foot", 24.9 * radians).name, "H");
  EXPECT_EQ(mixed.at("foot", -25.1 * radians).name, "G");
  EXPECT_EQ(mixed.at("cycle", 39.9 * radians).name, "H");
  EXPECT_EQ(mixed.at("cycle", 40.1 * radians).name, "G");
}

}  // namespace
