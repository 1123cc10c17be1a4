// Oracle: channels made from another by a known factor and offset, at the resolution of a converter or of a printed number; and
// sensors side by side, which are no copies; rows counted.
#include "identification/lying_channels.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd sensor_noise(unsigned seed) {
  std::srand(seed);
  return VectorXd::Random(4000) + VectorXd::Random(4000) + VectorXd::Random(4000);
}

VectorXd rounded(const VectorXd& x, double step) { return (x / step).array().round() * step; }

/// Why the second of two channels is left out.
std::string reason(const VectorXd& a, const VectorXd& b, bool decay = false, double gain_b = 1.0) {
  Samples raw(a.size(), 2);
  raw << a, b * gain_b;
  auto quality = channel_quality(raw, {"A", "B"}, "S1", "r.csv");
  judge_channels(raw, {{0, 1}, {1.0, gain_b}, {false, false}, decay}, quality);
  EXPECT_EQ(quality[0].left_out, "");
  return quality[1].left_out;
}

TEST(LyingChannel, ACopyTimesAFactorPlusAnOffset) {
  const VectorXd a = rounded(sensor_noise(1), 1e-4);
  EXPECT_EQ(reason(a, a), "is a copy of A: both hold the same values");
  EXPECT_EQ(reason(a, a, false, 9.81), "is a copy of A: both hold the same values");
  EXPECT_EQ(reason(a, -a), "is a copy of A: in each sample B = -1 A + 0");
  EXPECT_EQ(reason(a, 2.5 * a.array() + 3.0), "is a copy of A: in each sample B = 2.5 A + 3");
  EXPECT_NE(reason(a, 2.5 * a.array() - 3.0, false, 9.81).find("B = 2.5 A - 3"), std::string::npos);
  for (const double step : {1e-9, 1e-4, 5e-4})
    EXPECT_NE(reason(a, rounded(0.37 * a.array() - 20.0, step)).find("is a copy of A"), std::string::npos) << step;
  const VectorXd single = (0.0123 * sensor_noise(1)).cast<float>().cast<double>();
  EXPECT_NE(reason(single, (7.0 * single).cast<float>().cast<double>()).find("B = 7 A"), std::string::npos);
}

TEST(LyingChannel, TheNumberOfTheRow) {
  const VectorXd a = sensor_noise(1), rows = VectorXd::LinSpaced(4000, 17.0, 17.0 + 3999.0);
  EXPECT_EQ(reason(a, rows), "counts its rows: each sample is one step on from the last");
  EXPECT_EQ(reason(a, rows, false, 9.81), "counts its rows: each sample is one step on from the last");
  EXPECT_EQ(reason(a, rows + 1e-3 * sensor_noise(2)), "");  // a sensor that drifts
}

TEST(LyingChannel, SensorsSideBySideAreNoCopies) {
  const VectorXd a = sensor_noise(1);
  for (const double apart : {1e-2, 1e-3}) {  // noise of the second, 40 and 60 dB down
    EXPECT_EQ(reason(a, a + apart * sensor_noise(2)), "") << apart;
    EXPECT_EQ(reason(rounded(a, apart), rounded(a + apart * sensor_noise(2), apart)), "") << apart;
  }
  EXPECT_EQ(reason(rounded(a, 0.5), rounded(1.1 * a, 0.5)), "");  // coarse
}

TEST(LyingChannel, AllInProportionIsOneMotion) {
  const VectorXd a = sensor_noise(1);
  Samples raw(a.size(), 3);
  raw << a, 0.5 * a, -2.0 * a;
  auto quality = channel_quality(raw, {"A", "B", "C"}, "S1", "r.csv");
  judge_channels(raw, {{0, 1, 2}, {1.0, 1.0, 1.0}, {false, false, false}, false}, quality);
  for (const ChannelQuality& q : quality) EXPECT_EQ(q.left_out, "");
}

TEST(LyingChannel, FiveDigitsOfEachNumber) {
  const VectorXd a = 4.0 * sensor_noise(1), b = 3.0 - 2.5 * a.array();
  const auto printed = [](const VectorXd& x) {
    return VectorXd(x.unaryExpr([](double value) { return std::stod(fmt::format("{:.5g}", value)); }));
  };
  EXPECT_NE(reason(printed(a), printed(b)).find("B = -2.5"), std::string::npos);
}

TEST(LyingChannel, ADecayInOneModeIsInProportion) {
  const VectorXd a = sensor_noise(1);
  EXPECT_EQ(reason(a, 0.5 * a, true), "");
  EXPECT_NE(reason(a, a, true), "");
}

TEST(LyingChannel, APureSineIsInProportion) {
  const VectorXd a = VectorXd::LinSpaced(4000, 0.0, 25.0).array().sin();
  EXPECT_EQ(reason(a, -0.6 * a), "");
  const VectorXd two = a.array() + (1.7 * VectorXd::LinSpaced(4000, 0.0, 25.0)).array().sin();
  EXPECT_NE(reason(two, -0.6 * two), "");
}

TEST(LyingChannel, MissingSamplesStandInBothOrInNone) {
  VectorXd a = sensor_noise(1), b = 2.0 * a;
  a.segment(100, 10).setConstant(std::nan(""));
  EXPECT_EQ(reason(a, b), "");
  b.segment(100, 10).setConstant(std::nan(""));
  EXPECT_NE(reason(a, b).find("B = 2 A"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::identification
