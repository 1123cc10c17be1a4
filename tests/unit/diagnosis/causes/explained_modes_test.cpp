// Oracle: the likelihood written out for a model of two modes.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/causes/swinging_stays.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::MeasuredShape;
using diagnosis::VisibleModes;

MeasuredShape mode(const std::string& name, int condition, double f, std::vector<double> shape) {
  MeasuredShape m{name, condition, f, {}, Eigen::VectorXcd(std::ssize(shape))};
  for (std::size_t i = 0; i < shape.size(); ++i) {
    m.channels.push_back(static_cast<int>(i));
    m.values[static_cast<Eigen::Index>(i)] = shape[i];
  }
  return m;
}

VisibleModes two_modes() {
  VisibleModes modes{Eigen::Vector2d(1.0, 2.0), Eigen::MatrixXd(3, 2)};
  modes.shapes << 1, 1, 1, 0, 1, -1;
  return modes;
}

TEST(ExplainedModes, CountsAndWeighsAsWrittenOut) {
  // 1 is the first mode, 2 looks like it but lies elsewhere, 3 is the second mode seen in two conditions, once too far off.
  const std::vector<MeasuredShape> measured = {mode("1", 0, 1.01, {2, 2, 2}), mode("2", 0, 1.4, {1, 1, 0.9}),
                                               mode("3", 0, 2.05, {1, 0, -1}), mode("3", 1, 2.4, {1, 0, -1})};
  const diagnosis::ExplainedModes found = explain(measured, two_modes(), {0.6, 0.05});
  EXPECT_EQ(found.explained, (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(found.count, 2);
  EXPECT_EQ(found.mode[0], 0);
  EXPECT_EQ(found.mode[2], 1);
  // The band is ln(2.4/1.01) and 0.05 at each end. Of the first mode's window, ±0.05 about ln 1, its lower end is cut off.
  const double low = std::log(1.01) - 0.05, band = std::log(2.4) + 0.05 - low;
  const double c1 = (0.05 - low) / band, c2 = 0.1 / band;
  const double expected = std::log(0.7 / c1) + std::log(0.3 / (1 - c1)) + 0.5 * (std::log(0.7 / c2) + std::log(0.3 / (1 - c2)));
  EXPECT_NEAR(found.log_likelihood, expected, 1e-12);
}

// A mode is explained up to `within` in the logarithm of its frequency, and down to the least MAC.
TEST(ExplainedModes, TheLimitsAreWhereTheRuleSays) {
  const diagnosis::ExplanationRule rule{0.6, 0.05};
  const auto explained = [&](double f, std::vector<double> shape) {
    return explain({mode("1", 0, f, std::move(shape))}, two_modes(), rule).count;
  };
  EXPECT_EQ(explained(std::exp(0.049), {1, 1, 1}), 1);
  EXPECT_EQ(explained(std::exp(0.051), {1, 1, 1}), 0);
  EXPECT_EQ(explained(std::exp(-0.051), {1, 1, 1}), 0);
  // MAC of (1, 1, x) with (1, 1, 1) is (2 + x)²/(3 (2 + x²)): 0.6 at x = (4 - sqrt(17.28))/1.6.
  const double limit = (4.0 - std::sqrt(17.28)) / 1.6;
  EXPECT_EQ(explained(1.0, {1, 1, limit + 0.01}), 1);
  EXPECT_EQ(explained(1.0, {1, 1, limit - 0.01}), 0);
}

// Oracle: written out. Windows that overlap count once, and what lies beyond the band not at all.
TEST(ExplainedModes, OverlappingWindowsCountOnce) {
  VisibleModes modes{Eigen::Vector3d(1.0, 1.05, 3.0), Eigen::MatrixXd::Ones(2, 3)};
  const std::vector<MeasuredShape> measured = {mode("1", 0, 0.9, {1, 1}), mode("2", 0, 3.0, {1, 1})};
  const double within = 0.04, low = std::log(0.9) - within, high = std::log(3.0) + within;
  const double c = (std::log(1.05) - std::log(1.0) + 2 * within + 2 * within) / (high - low);
  const diagnosis::ExplainedModes found = explain(measured, modes, {0.6, within});
  EXPECT_EQ(found.explained, (std::vector<bool>{false, true}));
  EXPECT_NEAR(found.log_likelihood, std::log(0.3 / (1 - c)) + std::log(0.7 / c), 1e-12);
}

TEST(ExplainedModes, AModeIsGivenAwayOnce) {
  const std::vector<MeasuredShape> measured = {mode("1", 0, 1.0, {1, 1, 1}), mode("2", 0, 1.02, {1, 1, 1})};
  EXPECT_EQ(explain(measured, two_modes(), {0.6, 0.05}).count, 1);
}

TEST(ExplainedModes, ScatterIsTheModelsOwn) {
  const std::vector<MeasuredShape> measured = {mode("1", 0, 1.02, {1, 1, 1}), mode("2", 0, 2.04, {1, 0, -1})};
  EXPECT_NEAR(frequency_scatter(measured, two_modes(), 0.6), 2.0 * std::log(1.02) / 0.6745, 1e-12);
  const std::vector<MeasuredShape> exact = {mode("1", 0, 1.0, {1, 1, 1})};
  EXPECT_EQ(frequency_scatter(exact, two_modes(), 0.6), 0.02);
  const std::vector<MeasuredShape> strange = {mode("1", 0, 1.0, {1, -2, 1})};
  EXPECT_EQ(frequency_scatter(strange, two_modes(), 0.6), 0.10);
}

}  // namespace
}  // namespace twindeck::tests
