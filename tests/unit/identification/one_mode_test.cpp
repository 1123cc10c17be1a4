// Oracles: hand-made modes; of two estimates of one quantity the mean weighted by 1/variance, by hand.
#include "identification/one_mode.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace twindeck::identification {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

identification::MergedMode mode_at(double frequency_Hz, double deviation_Hz, const Eigen::VectorXcd& shape, std::size_t setup) {
  identification::MergedMode mode;
  mode.frequency_Hz = frequency_Hz;
  mode.damping_ratio = 0.01;
  mode.deviation.frequency_Hz = deviation_Hz;
  mode.deviation.damping_ratio = 0.001;
  mode.deviation.shape_real = mode.deviation.shape_imag = Eigen::VectorXd::Constant(shape.size(), 0.01);
  mode.shape = shape;
  mode.members = {{setup, 0}};
  return mode;
}

ConditionResult with(std::vector<identification::MergedMode> modes) {
  ConditionResult result;
  result.condition = "calm";
  result.channels.resize(static_cast<std::size_t>(modes.front().shape.size()));
  result.checks.resize(modes.size());
  for (std::size_t m = 0; m < modes.size(); ++m) result.checks[m].frequency_Hz = modes[m].frequency_Hz;
  result.modes = std::move(modes);
  return result;
}

const Eigen::Vector3cd first(1.0, 0.5, -0.2), second(1.0, -1.0, 0.3);

// 1.200 (0.002) and 1.206 (0.004): weights 16 and 4, mean 1.2012; the deviation holds the other, hypot(0.002, 0.006).
TEST(MergeModesThatAreOne, TakesTheWeightedMeanAndNamesBoth) {
  ConditionResult result = with({mode_at(0.8, 0.002, second, 0), mode_at(1.2, 0.002, first, 0),
                                 mode_at(1.206, 0.004, -first, 1), mode_at(2.0, 0.002, second, 0)});
  const auto lines = merge_modes_that_are_one(result);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("1.2 and 1.206 Hz are one, mode 2"), std::string::npos) << lines[0];
  ASSERT_EQ(result.modes.size(), 3U);
  EXPECT_NEAR(result.modes[1].frequency_Hz, 1.2012, 1e-12);
  EXPECT_NEAR(result.modes[1].deviation.frequency_Hz, std::hypot(0.002, 0.006), 1e-12);
  EXPECT_EQ(result.modes[1].members.size(), 2U);
  ASSERT_EQ(result.checks.size(), 3U);
  EXPECT_EQ(result.checks[2].frequency_Hz, 2.0);
}

// The second setup lacks channel 3 and the first lacks channel 2, of the opposite sign and half the scale.
TEST(MergeModesThatAreOne, FillsChannelsThatTheSurerModeLacks) {
  ConditionResult result = with({mode_at(1.2, 0.002, Eigen::Vector4cd(1.0, kUnknown, -0.2, 0.6), 0),
                                 mode_at(1.203, 0.004, Eigen::Vector4cd(-0.5, -0.25, kUnknown, -0.3), 1)});
  ASSERT_EQ(merge_modes_that_are_one(result).size(), 1U);
  EXPECT_NEAR(result.modes[0].shape[1].real(), 0.5, 1e-12);
  EXPECT_NEAR(result.modes[0].deviation.shape_real[1], 0.02, 1e-12);
  EXPECT_NEAR(result.modes[0].shape[2].real(), -0.2, 1e-12);
}

TEST(MergeModesThatAreOne, LeavesModesThatTheRecordsTellApart) {
  ConditionResult shapes = with({mode_at(1.2, 0.002, first, 0), mode_at(1.203, 0.002, second, 0)});
  ConditionResult frequencies = with({mode_at(1.2, 0.002, first, 0), mode_at(1.21, 0.002, first, 0)});  // 3.5 deviations
  for (ConditionResult* result : {&shapes, &frequencies}) {
    EXPECT_TRUE(merge_modes_that_are_one(*result).empty());
    EXPECT_EQ(result->modes.size(), 2U);
  }
  ConditionResult one =
      with({mode_at(1.2, 0.002, Eigen::VectorXcd::Ones(1), 0), mode_at(1.201, 0.002, Eigen::VectorXcd::Ones(1), 0)});
  EXPECT_TRUE(merge_modes_that_are_one(one).empty());
}

}  // namespace
}  // namespace twindeck::identification
