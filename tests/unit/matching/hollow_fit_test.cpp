// Oracle: comparisons and shapes as they are written here; the MAC of (1, 1, 1, x) with (1, 1, 1, y) in closed form.
#include "matching/hollow_fit.hpp"

#include <gtest/gtest.h>

namespace twindeck::matching {
namespace {

struct Told : Reporter {
  std::vector<std::string> lines;
  void warn(const std::string& line) override { lines.push_back(line); }
};

ComparisonRow row(const std::string& stage, const std::string& mode, double computed_Hz, std::optional<double> mac) {
  return {stage, mode, "2N", 1.0, computed_Hz, mac, "mac"};
}

Measured hollow_shapes(const Eigen::MatrixXcd& shapes) {
  Measured measured;
  measured.modes.frequency_Hz = Eigen::VectorXd::LinSpaced(shapes.cols(), 1.0, 2.0);
  measured.modes.shapes = shapes;
  for (Eigen::Index i = 0; i < shapes.rows(); ++i) measured.modes.dofs.push_back({std::to_string(i), "z"});
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) measured.labels.push_back(std::to_string(i + 1) + "X");
  return measured;
}

TEST(HollowFit, TellsAShapeThatBecameWorseUnderAFrequencyThatFits) {
  const std::vector<ComparisonRow> bad = {row("before", "2X", 1.0958, 0.998), row("after", "2X", 1.005, 0.68)};
  EXPECT_EQ(worse_shapes(bad), std::vector<std::string>{"2X-2N (MAC 0.998 to 0.68, frequency error 9.58 to 0.50 %)"});
}

TEST(HollowFit, IsSilentWhereMacStaysOrTheFrequencyIsNoNearer) {
  EXPECT_TRUE(worse_shapes({row("before", "2X", 1.10, 0.99), row("after", "2X", 1.01, 0.90)}).empty());
  EXPECT_TRUE(worse_shapes({row("before", "2X", 1.01, 0.99), row("after", "2X", 1.02, 0.60)}).empty());
  EXPECT_TRUE(worse_shapes({row("before", "2X", 1.10, std::nullopt), row("after", "2X", 1.01, 0.60)}).empty());
  EXPECT_TRUE(worse_shapes({row("before", "1X", 1.10, 0.99), row("after", "2X", 1.01, 0.60)}).empty());
}

// (1, 1, 1, 1) and (1, 1, 1, 0.5): 3.5² / (4 · 3.25) = 0.942, below the limit; with 0.6: 3.6² / (4 · 3.36) = 0.964.
TEST(HollowFit, TellsTwoMeasuredModesWithOneShape) {
  const std::vector<ComparisonRow> both = {row("after", "1X", 1.0, 0.9), row("after", "2X", 1.0, 0.9)};
  Eigen::MatrixXcd shapes = Eigen::MatrixXcd::Ones(4, 2);
  shapes(3, 1) = 0.5;
  EXPECT_TRUE(shared_shapes(hollow_shapes(shapes), both).empty());
  shapes(3, 1) = 0.6;
  EXPECT_EQ(shared_shapes(hollow_shapes(shapes), both), std::vector<std::string>{"1X and 2X (MAC 0.96)"});
  EXPECT_TRUE(shared_shapes(hollow_shapes(shapes), {row("after", "1X", 1.0, 0.9)}).empty()) << "the other is not in use";
  shapes.bottomRows(2).col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(shared_shapes(hollow_shapes(shapes), both).empty()) << "two channels in common";
}

TEST(HollowFit, WarnsOnceOfEachKind) {
  Told told;
  warn_of_hollow_fit(told, hollow_shapes(Eigen::MatrixXcd::Ones(3, 2)),
                     {row("before", "1X", 1.2, 0.9), row("after", "1X", 1.0, 0.5), row("after", "2X", 1.0, 0.9)},
                     {"E_deck (upper)"});
  ASSERT_EQ(told.lines.size(), 3U);
  EXPECT_NE(told.lines[2].find("on a bound: E_deck (upper): the data would push the value further"), std::string::npos);
  Told quiet;
  warn_of_hollow_fit(quiet, Measured(), {row("before", "1X", 1.2, 0.9), row("after", "1X", 1.0, 0.95)}, {});
  EXPECT_TRUE(quiet.lines.empty());
}

}  // namespace
}  // namespace twindeck::matching
