/// Oracle: frequencies with one slip put in; the same frequencies without it, and right models with modes that no sensor sees,
/// are left in peace.
#include "dynamics/measured_slips.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace twindeck::dynamics {
namespace {

std::string only_one(const std::vector<std::string>& slips) {
  EXPECT_EQ(slips.size(), 1U);
  return slips.empty() ? "" : slips.front();
}

TEST(MeasuredSlips, OneFactorThatNoParameterReachesIsRefused) {
  const Eigen::Vector4d computed(0.384, 0.723, 0.847, 4.5);
  const MeasuredFrequencies measured{{"1", "2", "3"}, Eigen::Vector3d(1.2142, 2.2873, 2.6795)};
  ASSERT_TRUE(one_factor(measured, computed).has_value());
  EXPECT_NEAR(*one_factor(measured, computed), 3.16, 0.02);
  LoadedModel loaded;
  loaded.source = "model";
  loaded.system.parameters = {{"E", fe::Target::youngs_modulus, {"steel"}, "Pa", 200e9, 150e9, 250e9}};
  EXPECT_THROW(refuse_one_factor(loaded, computed, {measured}, FactorWithinBounds::passes), InputError);
  loaded.system.parameters[0].upper = 2500e9;  // reaches a factor of ten
  EXPECT_NO_THROW(refuse_one_factor(loaded, computed, {measured}, FactorWithinBounds::passes));
  EXPECT_THROW(refuse_one_factor(loaded, computed, {measured}, FactorWithinBounds::is_refused), InputError);
  loaded.system.parameters.clear();
  const MeasuredFrequencies two{{"1", "2"}, Eigen::Vector2d(1.2142, 2.2873)};
  EXPECT_NO_THROW(refuse_one_factor(loaded, computed, {two}, FactorWithinBounds::passes));
  const MeasuredFrequencies uneven{{"1", "2", "3"}, Eigen::Vector3d(1.2142, 2.2873, 3.9)};
  EXPECT_NO_THROW(refuse_one_factor(loaded, computed, {uneven}, FactorWithinBounds::passes));
}

/// A girder in space whose section is sqrt(Iy / Iz) = 3.38 times as fast upwards as sideways, which is near sqrt(9.81). Its
/// vertical modes are the computed ones 4, 7 and 9, which were measured.
const Eigen::VectorXd girder_Hz{{0.3553, 0.6693, 0.7840, 1.2022, 1.3139, 2.2633, 2.2646, 2.5665, 2.6529}};
const MeasuredFrequencies vertical_Hz{{"1", "2", "3"}, Eigen::Vector3d(1.2142, 2.2873, 2.6795)};

MeasuredFrequencies with_shapes(MeasuredFrequencies measured, const std::vector<Eigen::Index>& computed) {
  measured.mac = Eigen::MatrixXd::Zero(girder_Hz.size(), measured.frequency_Hz.size());
  for (std::size_t i = 0; i < computed.size(); ++i) measured.mac(computed[i], static_cast<Eigen::Index>(i)) = 0.99;
  return measured;
}

TEST(MeasuredSlips, ModesThatNoSensorSeesAreNoSlip) {
  EXPECT_FALSE(one_factor(vertical_Hz, girder_Hz));
  const std::string both = only_one(measured_slips(vertical_Hz, girder_Hz));
  EXPECT_NE(both.find("is a weight in newtons given as a mass in kilograms? Or the measured modes are others of the computed"),
            std::string::npos)
      << both;
  const MeasuredFrequencies shapes = with_shapes(vertical_Hz, {3, 6, 8});
  EXPECT_FALSE(one_factor(shapes, girder_Hz));
  EXPECT_TRUE(measured_slips(shapes, girder_Hz).empty());
}

TEST(MeasuredSlips, ShapesTellTheFactorOfAWeight) {
  const Eigen::VectorXd weight_Hz = girder_Hz / std::sqrt(9.80665);
  EXPECT_FALSE(one_factor(vertical_Hz, weight_Hz));  // in the order of both it is 10.7
  ASSERT_TRUE(one_factor(with_shapes(vertical_Hz, {3, 6, 8}), weight_Hz));
  EXPECT_NEAR(*one_factor(with_shapes(vertical_Hz, {3, 6, 8}), weight_Hz), 1.01 * std::sqrt(9.80665), 0.01);
  const std::string slip = only_one(measured_slips(with_shapes(vertical_Hz, {3, 6, 8}), weight_Hz));
  EXPECT_NE(slip.find("3.16 times those of the computed modes with their shapes (0.384 to 0.847 Hz): is a weight in newtons"),
            std::string::npos)
      << slip;
  const MeasuredFrequencies two{{"1", "2"}, vertical_Hz.frequency_Hz.head(2)};
  EXPECT_TRUE(one_factor(with_shapes(two, {3, 6}), weight_Hz));
  EXPECT_FALSE(one_factor(with_shapes(two, {3}), weight_Hz));  // one shape, and two ratios agree by chance
  EXPECT_FALSE(one_factor(two, weight_Hz));
}

TEST(MeasuredSlips, ComputedModesThatEndBelowTheMeasuredOnesLeaveItOpen) {
  EXPECT_FALSE(one_factor(vertical_Hz, girder_Hz.head(3)));
  EXPECT_TRUE(one_factor(vertical_Hz, girder_Hz.head(3), true));  // the model's own numbers show a slip as well
  EXPECT_TRUE(one_factor({{"1", "2", "3"}, girder_Hz.head(3) / std::sqrt(9.80665)}, girder_Hz.head(3)));  // none lies below
}

TEST(MeasuredSlips, FactorsInFeet) {
  const auto words = [](double gravity) { return slip_of_factor(1.0 / std::sqrt(gravity)).value_or(""); };
  EXPECT_EQ(words(32.174),
            "is a weight in lbf given as a mass in slugs (divide by 32.174), or are the measured frequencies in rad/s?");
  EXPECT_EQ(slip_of_factor(1.0 / 6.2832).value_or("").find("are the measured frequencies in rad/s, or is a weight"), 0U);
  EXPECT_EQ(words(9.81), "is a weight in newtons given as a mass in kilograms?");
  EXPECT_FALSE(slip_of_factor(2.0));
}

TEST(MeasuredSlips, OneMeasuredFrequencyAmongHertz) {
  const MeasuredFrequencies measured{{"1", "2", "3", "4"}, Eigen::Vector4d(1.21, 2.43, 3618.7, 5.9)};
  const std::string slip = only_one(measured_slips(measured, Eigen::Vector4d(1.2, 2.4, 3.6, 6.0)));
  EXPECT_NE(slip.find("mode 3 is measured at 3618.7 Hz, but the others lie between 1.21 and 5.9 Hz: is it in mHz"),
            std::string::npos)
      << slip;
  const std::string low = only_one(measured_slips({{"1", "2", "3"}, Eigen::Vector3d(0.0024, 2.9, 3.6)}, {}));
  EXPECT_NE(low.find("mode 1 is measured at 0.0024 Hz"), std::string::npos) << low;
  EXPECT_NE(low.find("kHz"), std::string::npos) << low;
  EXPECT_TRUE(measured_slips({{"1", "2"}, Eigen::Vector2d(0.2, 6.0)}, {}).empty());
}

TEST(MeasuredSlips, MeasuredAgainstComputed) {
  const Eigen::Vector3d computed(1.2, 2.4, 3.6);
  const auto slip_of = [&](double factor) {
    return only_one(measured_slips({{"1", "2", "3"}, Eigen::Vector3d(factor * Eigen::Vector3d(1.25, 2.3, 3.7))}, computed));
  };
  EXPECT_NE(slip_of(6.2832).find("rad/s"), std::string::npos) << slip_of(6.2832);
  EXPECT_NE(slip_of(1000.0).find("mHz"), std::string::npos) << slip_of(1000.0);
  EXPECT_NE(slip_of(60.0).find("cycles per minute"), std::string::npos) << slip_of(60.0);
  EXPECT_NE(slip_of(31.6).find("kN/m"), std::string::npos) << slip_of(31.6);
  EXPECT_NE(slip_of(150.0).find("check the units of both"), std::string::npos) << slip_of(150.0);
  EXPECT_NE(slip_of(3.13).find("a weight in newtons"), std::string::npos) << slip_of(3.13);
  for (const double error : {0.25, 0.8, 1.0, 1.5, 2.5})  // a poor model, no slip
    EXPECT_TRUE(measured_slips({{"1", "2", "3"}, Eigen::Vector3d(error * computed)}, computed).empty());
}

}  // namespace
}  // namespace twindeck::dynamics
