// Oracles: rows of the paper's Table 11 at 60 degrees of yaw, cos = 1/2, by hand; the oblique strip B' = B/cos, L' = L cos put
// into the dimensional block; symmetry of the yaw; the limit of a normal wind.
#include "aero/yaw_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"

namespace {

using namespace twindeck;
using aero::ForceAxes;

// By hand from Table 11: what the statics, the looked-up velocity and the block are multiplied with at cos = 1/2.
TEST(YawRule, RowsOfTable11AtSixtyDegrees) {
  struct Row {
    std::string name;
    double force, moment, lookup, block;
    ForceAxes axes;
  };
  const std::vector<Row> rows = {{"A", 1, 1, 1, 1, ForceAxes::deck},         {"C", 0.25, 0.25, 0.5, 1, ForceAxes::deck},
                                 {"D", 0.25, 0.25, 0.5, 4, ForceAxes::deck}, {"G", 0.25, 0.25, 0.5, 4, ForceAxes::wind},
                                 {"H", 1, 2, 0.5, 1, ForceAxes::wind},       {"I", 1, 2, 0.5, 4, ForceAxes::wind}};
  for (const Row& row : rows) {
    const aero::YawRule& rule = aero::published_yaw_rule(row.name);
    for (const double yaw : {60 * radians, -60 * radians}) {  // the cosine does not know the sign
      const aero::StaticFactor statics = aero::static_factor(rule, yaw);
      EXPECT_NEAR(statics.force, row.force, 1e-14) << row.name;
      EXPECT_NEAR(statics.moment, row.moment, 1e-14) << row.name;
      EXPECT_NEAR(aero::lookup_factor(rule, yaw), row.lookup, 1e-14) << row.name;
      EXPECT_LT((aero::block_factor(rule, yaw).array() - row.block).abs().maxCoeff(), 1e-13) << row.name;
    }
    EXPECT_EQ(rule.axes, row.axes) << row.name;
  }
  EXPECT_EQ(aero::published_yaw_rule_names(), (std::vector<std::string>{"A", "C", "D", "G", "H", "I"}));
}

// c = ½ρωB'²L' with one more B' for the moment and for the rotation, over the same of B and L.
TEST(YawRule, ObliqueHIsTheBlockOfTheObliqueStrip) {
  const aero::YawRule rule = aero::oblique_rule_H();
  const double yaw = -0.7, B = 4.5, L = 5.0, oblique_B = B / std::cos(yaw), oblique_L = L * std::cos(yaw);
  const Eigen::Vector3d arm(1, 1, B), oblique_arm(1, 1, oblique_B);
  const Eigen::Matrix3d expected = (oblique_B * oblique_B * oblique_L * oblique_arm * oblique_arm.transpose())
                                       .cwiseQuotient(B * B * L * arm * arm.transpose());
  EXPECT_LT((aero::block_factor(rule, yaw) - expected).norm(), 1e-13);
  // The static part of the same strip: B'L' for forces, B'²L' for the moment.
  EXPECT_NEAR(aero::static_factor(rule, yaw).force, oblique_B * oblique_L / (B * L), 1e-14);
  EXPECT_NEAR(aero::static_factor(rule, yaw).moment, oblique_B * oblique_B * oblique_L / (B * B * L), 1e-14);
  EXPECT_EQ(rule.axes, ForceAxes::wind);
  EXPECT_NE(rule.name, "H");
}

// Limit: in a normal wind every rule is rule A, but for the axes, which then agree.
TEST(YawRule, AllRulesAreOneInANormalWind) {
  std::vector<aero::YawRule> rules = aero::published_yaw_rules();
  rules.push_back(aero::oblique_rule_H());
  for (const aero::YawRule& rule : rules) {
    EXPECT_EQ(aero::static_factor(rule, 0.0).force, 1.0) << rule.name;
    EXPECT_EQ(aero::static_factor(rule, 0.0).moment, 1.0) << rule.name;
    EXPECT_EQ(aero::lookup_factor(rule, 0.0), 1.0) << rule.name;
    EXPECT_EQ(aero::block_factor(rule, 0.0), Eigen::Matrix3d::Ones()) << rule.name;
  }
}

TEST(YawRule, AnUnknownNameIsRefusedWithTheKnownOnes) {
  try {
    static_cast<void>(aero::published_yaw_rule("B"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("A, C, D, G, H, I"), std::string::npos) << error.what();
  }
}

// A wind along the deck, one from behind, and no number at all.
TEST(YawRule, YawOfNinetyDegreesAndBeyondIsRefused) {
  for (const double yaw_deg : {90.0, -90.0, 91.0, 180.0, 360.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(static_cast<void>(aero::yaw_cosine(yaw_deg * radians)), InputError) << yaw_deg;
    for (const aero::YawRule& rule : aero::published_yaw_rules()) {
      EXPECT_THROW(static_cast<void>(aero::block_factor(rule, yaw_deg * radians)), InputError) << yaw_deg;
      EXPECT_THROW(static_cast<void>(aero::lookup_factor(rule, yaw_deg * radians)), InputError) << yaw_deg;
      EXPECT_THROW(static_cast<void>(aero::static_factor(rule, yaw_deg * radians)), InputError) << yaw_deg;
    }
  }
  EXPECT_NEAR(aero::yaw_cosine(60 * radians), 0.5, 1e-15);
  EXPECT_NEAR(aero::yaw_cosine(-89 * radians), std::cos(89 * radians), 1e-15);
}

// Table 14: another rule on one deck beyond an angle, on both sides of the normal. The other deck keeps the first rule.
TEST(Deployment, AZoneHoldsOnItsDeckBeyondItsAngle) {
  aero::Deployment mixed = aero::everywhere(aero::published_yaw_rule("A"));
  EXPECT_EQ(mixed.name, "A");
  EXPECT_EQ(mixed.at("foot", 1.0).name, "A");
  mixed.zones = {{"foot", 20 * radians, aero::published_yaw_rule("D")}, {"cycle", 40 * radians, aero::published_yaw_rule("H")}};
  EXPECT_EQ(mixed.at("foot", 19 * radians).name, "A");
  EXPECT_EQ(mixed.at("foot", 20 * radians).name, "A");  // beyond, not at
  EXPECT_EQ(mixed.at("foot", 21 * radians).name, "D");
  EXPECT_EQ(mixed.at("foot", -21 * radians).name, "D");
  EXPECT_EQ(mixed.at("cycle", -21 * radians).name, "A");
  EXPECT_EQ(mixed.at("cycle", -41 * radians).name, "H");
  EXPECT_EQ(mixed.at("road", 80 * radians).name, "A");
}

}  // namespace
