// Oracles: hand calculations on chosen setups (weighted means, DerSimonian and Laird); invariance to a setup's complex gain and
// to the order of setups; n like setups are one with deviations smaller by sqrt(n).
#include "identification/merge_poser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/error.hpp"

namespace twindeck::identification {
namespace {

using Complex = std::complex<double>;

/// A setup of one mode over three channels, the first two of them references. Shapes have unit norm.
SetupModes setup_of(double frequency_Hz, double deviation_Hz, const Eigen::Vector3cd& shape, Eigen::Index moving = 2) {
  Cluster mode;
  mode.frequency_Hz = frequency_Hz;
  mode.damping_ratio = 0.01;
  mode.shape = shape.normalized();
  ModeDeviation deviation;
  deviation.frequency_Hz = deviation_Hz;
  deviation.damping_ratio = 0.001;
  deviation.shape_real = Eigen::Vector3d::Constant(0.01);
  deviation.shape_imag = Eigen::Vector3d::Zero();
  return {"S", {0, 1, moving}, {mode}, {deviation}};
}

const Eigen::Vector3cd kSwaying(0.6, 0.5, -0.4);

// Frequencies 1.00 and 1.02 of like deviations 0.1: excess < 0, so that tau² = 0; mean 1.01, deviation 0.1/sqrt(2), scatter
// 0.02/sqrt(2).
TEST(MergedFrequency, LikeDeviationsGiveTheMean) {
  const auto merged = merge_poser({setup_of(1.0, 0.1, kSwaying), setup_of(1.02, 0.1, kSwaying)}, 3, {0, 1}, {0.03});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].frequency_Hz, 1.01, 1e-14);
  EXPECT_NEAR(merged[0].deviation.frequency_Hz, 0.1 / std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(merged[0].frequency_scatter_Hz, 0.02 / std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(merged[0].deviation.damping_ratio, 0.001 / std::sqrt(2.0), 1e-16);
  EXPECT_EQ(merged[0].damping_ratio_scatter, 0.0);
}

// Variances 0.01 and 0.04: weights 4 to 1. The mean of 1.00 and 1.02 is 1.004, its variance 1/(100 + 25).
TEST(MergedFrequency, TheBetterKnownCountsMore) {
  const auto merged = merge_poser({setup_of(1.0, 0.1, kSwaying), setup_of(1.02, 0.2, kSwaying)}, 3, {0, 1}, {0.03});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].frequency_Hz, 1.004, 1e-14);
  EXPECT_NEAR(merged[0].deviation.frequency_Hz, std::sqrt(1.0 / 125.0), 1e-14);
}

// Setups that differ by far more than their deviations. With like variances s² tau² is the sample variance less s², so that the
// variance of the mean is the sample variance over n: (0.01² + 0.01²)/1 / 2 = 1e-4.
TEST(MergedFrequency, SetupsThatDisagreeWidenTheDeviation) {
  const auto merged = merge_poser({setup_of(1.0, 1e-4, kSwaying), setup_of(1.02, 1e-4, kSwaying)}, 3, {0, 1}, {0.03});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].frequency_Hz, 1.01, 1e-14);
  EXPECT_NEAR(merged[0].deviation.frequency_Hz, 0.01, 1e-12);
}

// Deviations of zero: the mean is finite.
TEST(MergedFrequency, DeviationsOfZeroGiveAFiniteMean) {
  const auto merged = merge_poser({setup_of(1.0, 0.0, kSwaying), setup_of(1.0, 0.0, kSwaying)}, 3, {0, 1}, {});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].frequency_Hz, 1.0, 1e-14);
  EXPECT_TRUE(std::isfinite(merged[0].deviation.frequency_Hz));
}

// Two setups see channels 2 and 3 of one shape; each normalises what it sees. Together: the shape over four channels.
TEST(MergedShape, IsPutTogetherOverTheReferences) {
  const Eigen::Vector4cd truth(0.6, 0.5, -0.4, 1.0);
  for (const Complex& gain : {Complex(1.0, 0.0), Complex(-2.0, 0.0), std::polar(0.3, 1.1)}) {
    const SetupModes first = setup_of(1.0, 0.01, truth({0, 1, 2})), second = setup_of(1.0, 0.01, gain * truth({0, 1, 3}), 3);
    for (const auto& setups : std::vector<std::vector<SetupModes>>{{first, second}, {second, first}}) {
      const auto merged = merge_poser(setups, 4, {0, 1}, {});
      ASSERT_EQ(merged.size(), 1U);
      EXPECT_LT((merged[0].shape - truth.normalized()).norm(), 1e-13);
      EXPECT_EQ(merged[0].members.size(), 2U);
      EXPECT_EQ(merged[0].members[0].first, 0U);
      EXPECT_EQ(merged[0].members[1].first, 1U);
    }
  }
}

/// Deviations of real and imaginary parts that differ from channel to channel.
SetupModes setup_with_deviations(const Eigen::Vector3cd& shape) {
  SetupModes setup = setup_of(1.0, 0.01, normalised_shape(shape));
  setup.deviations[0].shape_real = Eigen::Vector3d(0.01, 0.02, 0.03);
  setup.deviations[0].shape_imag = Eigen::Vector3d(0.001, 0.002, 0.003);
  return setup;
}
const Eigen::Vector3cd kComplexShape(Complex(0.6, 0.2), Complex(0.5, 0.3), Complex(-0.6, 0.3));

// Three times the same setup is that setup, with deviations of its shape divided by sqrt(3).
TEST(MergedShape, LikeSetupsGiveTheShapeWithSmallerDeviations) {
  const SetupModes setup = setup_with_deviations(kSwaying);
  const auto merged = merge_poser({setup, setup, setup}, 3, {0, 1}, {});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_LT((merged[0].shape - setup.modes[0].shape).norm(), 1e-13);
  EXPECT_LT((merged[0].deviation.shape_real * std::sqrt(3.0) - setup.deviations[0].shape_real).norm(), 1e-12);
  EXPECT_LT((merged[0].deviation.shape_imag * std::sqrt(3.0) - setup.deviations[0].shape_imag).norm(), 1e-12);
}

TEST(MergedShape, LikeSetupsGiveTheSameComplexShape) {
  const SetupModes setup = setup_with_deviations(kComplexShape);
  const auto merged = merge_poser({setup, setup, setup}, 3, {0, 1}, {});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_LT((merged[0].shape - setup.modes[0].shape).norm(), 1e-13);
  // The references' phase, which is not that of the whole shape, has no part in it.
  EXPECT_LT((merged[0].deviation.shape_real * std::sqrt(3.0) - setup.deviations[0].shape_real).norm(), 1e-12);
  EXPECT_LT((merged[0].deviation.shape_imag * std::sqrt(3.0) - setup.deviations[0].shape_imag).norm(), 1e-12);
}

TEST(MergedShape, OneSetupKeepsItsDeviations) {
  const SetupModes setup = setup_of(1.0, 0.01, kSwaying);
  const auto merged = merge_poser({setup}, 3, {}, {});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_LT((merged[0].shape - kSwaying.normalized()).norm(), 1e-14);
  EXPECT_LT((merged[0].deviation.shape_real - Eigen::Vector3d::Constant(0.01)).norm(), 1e-15);
  EXPECT_EQ(merged[0].deviation.shape_imag.norm(), 0.0);
  EXPECT_EQ(merged[0].frequency_scatter_Hz, 0.0);
}

// Channel 2 of both setups, values 1 and 1.2 beside like references of (1, 1), variances 1 to 16 (powers of two, which the
// weight keeps): the mean is (16 · 1 + 1.2)/17 in units of the references.
TEST(MergedShape, AChannelOfSeveralSetupsIsTheWeightedMean) {
  SetupModes first = setup_of(1.0, 0.01, {1.0, 1.0, 1.0}), second = setup_of(1.0, 0.01, {1.0, 1.0, 1.2});
  const double scale[] = {first.modes[0].shape[0].real(), second.modes[0].shape[0].real()};  // of the references
  first.deviations[0].shape_real[2] = 0x1.0p-8;
  second.deviations[0].shape_real[2] = 0x1.0p-6;
  const auto merged = merge_poser({first, second}, 3, {0, 1}, {});
  ASSERT_EQ(merged.size(), 1U);
  // In units of the references the deviations are divided by the scale.
  const double w1 = 16.0 * scale[0] * scale[0], w2 = scale[1] * scale[1];
  EXPECT_NEAR((merged[0].shape[2] / merged[0].shape[0]).real(), (w1 * 1.0 + w2 * 1.2) / (w1 + w2), 1e-12);
}

// Two setups whose references agree in frequency alone: MAC 0 over the references makes two modes.
TEST(MergedGroups, AnotherShapeIsAnotherMode) {
  const auto merged =
      merge_poser({setup_of(1.0, 0.001, {1.0, 1.0, 0.0}), setup_of(1.001, 0.001, {1.0, -1.0, 0.0}, 3)}, 4, {0, 1}, {});
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0].frequency_Hz, 1.0);  // ascending
  EXPECT_EQ(merged[1].frequency_Hz, 1.001);
  EXPECT_TRUE(std::isnan(merged[0].shape[3].real()));
  EXPECT_TRUE(std::isnan(merged[1].shape[2].real()));
}

// Close modes whose order in frequency differs between setups: shapes tell them apart.
TEST(MergedGroups, CloseModesArePairedByShape) {
  SetupModes first = setup_of(1.000, 0.004, {1.0, 0.9, 0.3}), second = setup_of(1.003, 0.004, {1.0, 0.9, 0.2}, 3);
  const SetupModes other = setup_of(1.004, 0.004, {0.9, -1.0, 0.3}), same = setup_of(1.001, 0.004, {0.9, -1.0, 0.5}, 3);
  first.modes.push_back(other.modes[0]);
  first.deviations.push_back(other.deviations[0]);
  second.modes.insert(second.modes.begin(), same.modes[0]);
  second.deviations.insert(second.deviations.begin(), same.deviations[0]);
  const auto merged = merge_poser({first, second}, 4, {0, 1}, {});
  ASSERT_EQ(merged.size(), 2U);
  for (const MergedMode& mode : merged) {
    ASSERT_EQ(mode.members.size(), 2U);
    EXPECT_NE(mode.members[0].second, mode.members[1].second);  // first's 0 with second's 1
  }
}

// No two modes of one setup become one, however alike.
TEST(MergedGroups, TwoModesOfOneSetupStayTwo) {
  SetupModes setup = setup_of(1.0, 0.01, kSwaying);
  setup.modes.push_back(setup.modes[0]);
  setup.deviations.push_back(setup.deviations[0]);
  EXPECT_EQ(merge_poser({setup}, 3, {}, {}).size(), 2U);
  const auto merged = merge_poser({setup, setup_of(1.0, 0.01, kSwaying, 3)}, 4, {0, 1}, {});
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0].members.size() + merged[1].members.size(), 3U);
}

TEST(MergedGroups, NothingGivesNothing) {
  EXPECT_TRUE(merge_poser({}, 3, {0}, {}).empty());
  EXPECT_TRUE(merge_poser({{"S", {0, 1}, {}, {}}, {"T", {0, 1}, {}, {}}}, 3, {0}, {}).empty());
}

TEST(MergedGroups, ReferencesThatNotAllHaveAreRefusedWithTheSetupsName) {
  SetupModes without = setup_of(1.0, 0.01, kSwaying);
  without.setup = "pier";
  without.channels = {0, 3, 2};
  try {
    static_cast<void>(merge_poser({setup_of(1.0, 0.01, kSwaying), without}, 4, {0, 1}, {}));
    FAIL() << "a setup without a reference is accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("pier"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace twindeck::identification
