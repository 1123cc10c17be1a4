// Ranges, forms and trials of a calibration. Oracles: hand calculations on even and logarithmic scales; what is refused.
#include "ponte/calibration/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace twindeck::ponte {
namespace {

CalibrationValue value_of(const std::string& name, double start, double lower, double upper, std::vector<std::string> paths,
                          std::vector<double> factors) {
  CalibrationValue out;
  out.name = name;
  out.paths = std::move(paths);
  out.factors = std::move(factors);
  out.start = start, out.lower = lower, out.upper = upper;
  return out;
}

/// A logarithmic value of two paths, and an even one that shares the second.
Calibration two_values() {
  Calibration out;
  out.values = {value_of("area", 2.0, 1.0, 16.0, {"a", "b"}, {1.0, 10.0}), value_of("share", 0.5, 0.0, 2.0, {"b"}, {3.0})};
  out.values[1].linear = true;
  return out;
}

// Half of 1 to 16 is 4 in the logarithm and 8.5 evenly.
TEST(CalibrationValue, TravelsItsRangeInTheLogarithmOrEvenly) {
  CalibrationValue value = value_of("area", 2.0, 1.0, 16.0, {}, {});
  EXPECT_NEAR(value.at(0.5), 4.0, 1e-12);
  EXPECT_NEAR(value.part_of(2.0), 0.25, 1e-12);
  value.linear = true;
  EXPECT_NEAR(value.at(0.5), 8.5, 1e-12);
  EXPECT_NEAR(value.part_of(4.75), 0.25, 1e-12);
}

TEST(CalibrationValue, PartOfAndAtAreInverse) {
  CalibrationValue value = value_of("area", 3.0, 0.4, 7.0, {}, {});
  for (const bool linear : {false, true}) {
    value.linear = linear;
    EXPECT_NEAR(value.at(0.0), 0.4, 1e-13);
    EXPECT_NEAR(value.at(1.0), 7.0, 1e-13);
    for (const double part : {0.1, 0.35, 0.9}) EXPECT_NEAR(value.part_of(value.at(part)), part, 1e-13);
  }
}

// area = 16^0.5 = 4, share = 0.25 · 2 = 0.5: a = 4, b = (10 · 4) (3 · 0.5).
TEST(BridgeValues, MultiplyWhereTwoValuesMeet) {
  const ponte::Values values = bridge_values(two_values(), Eigen::Vector2d(0.5, 0.25));
  ASSERT_EQ(values.size(), 2U);
  EXPECT_NEAR(values.at("a"), 4.0, 1e-12);
  EXPECT_NEAR(values.at("b"), 60.0, 1e-11);
}

TEST(BridgeValues, AFormsValueStands) {
  Calibration calibration = two_values();
  calibration.set = {{"b", 7.0}, {"c", -1.0}};
  const ponte::Values values = bridge_values(calibration, Eigen::Vector2d(0.5, 0.25));
  ASSERT_EQ(values.size(), 3U);
  EXPECT_NEAR(values.at("a"), 4.0, 1e-12);
  EXPECT_EQ(values.at("b"), 7.0);
  EXPECT_EQ(values.at("c"), -1.0);
}

Calibration with_trials() {
  Calibration out = two_values();
  out.forms = {{"open", "", {}}, {"box", "", {{"b", 7.0}}}};
  out.trials = {{"first", "open", {1.0, 0.0, 0.0, 0.0}, 0.1}, {"second", "box", {1.0, 1.0, 0.0, 1.0}, 0.3}};
  return out;
}

TEST(ForTrial, TakesFormKindsAndPullOfTheTrial) {
  const Calibration second = for_trial(with_trials(), "second");
  EXPECT_EQ(second.weight, (std::array<double, 4>{1.0, 1.0, 0.0, 1.0}));
  EXPECT_DOUBLE_EQ(second.whole_range_costs, 0.3);
  EXPECT_EQ(second.set, (ponte::Values{{"b", 7.0}}));
  // `share` has no path left to fit, `area` has one.
  ASSERT_EQ(second.values.size(), 1U);
  EXPECT_EQ(second.values[0].name, "area");
  const Calibration first = for_trial(with_trials(), "first");
  EXPECT_TRUE(first.set.empty());
  EXPECT_EQ(first.values.size(), 2U);
}

TEST(ForTrial, RefusesATrialThatIsNotThere) {
  try {
    (void)for_trial(with_trials(), "secund");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("did you mean 'second'"), std::string::npos) << said;
    EXPECT_NE(said.find("first, second"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace twindeck::ponte
