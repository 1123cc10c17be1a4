// Oracles: closed-form shapes of a chain; a setup's gain cannot matter (property); one setup merged with nothing is itself.
#include <gtest/gtest.h>

#include "chain.hpp"
#include "core/error.hpp"
#include "identification/merge_poser.hpp"
#include "identification/merge_preger.hpp"
#include "modal/mac.hpp"
#include "signal/condition.hpp"

namespace twindeck::identification {
namespace {

const test::Chain kChain(5, 22.0, 0.01, 20.0);
const std::vector<std::vector<Eigen::Index>> kSetups = {{0, 3, 1}, {0, 3, 2}, {0, 3, 4}};  // 0 and 3 stay

IdentifyOptions options_of_three_modes() {
  IdentifyOptions o;
  o.block_rows = 25;
  o.maximum_order = 30;
  o.limits.highest_Hz = 6.5;  // of five modes the lower three and a half
  return o;
}

signal::BlockCorrelations blocks_of(std::size_t setup, double gain) {
  const Eigen::MatrixXd all = kChain.simulate(40000, 70 + setup, 0.02) * gain * (1.0 + static_cast<double>(setup));
  return signal::correlations(signal::detrended(all(Eigen::all, kSetups[setup])), {0, 1}, 50, 20);
}

SetupModes identified(std::size_t setup, double gain) {
  const Identification found = identify(blocks_of(setup, gain), 20.0, options_of_three_modes());
  return {"S" + std::to_string(setup), kSetups[setup], found.modes, found.deviations};
}

TEST(MergePoser, ShapesAreThoseOfTheChainAndAGainOfThreeChangesNothing) {
  std::vector<SetupModes> setups = {identified(0, 1.0), identified(1, 1.0), identified(2, 1.0)};
  const auto merged = merge_poser(setups, 5, {0, 3}, {});
  setups[1] = identified(1, 3.0);
  const auto again = merge_poser(setups, 5, {0, 3}, {});
  ASSERT_GE(merged.size(), 3U);
  ASSERT_EQ(merged.size(), again.size());
  for (std::size_t m = 0; m < merged.size(); ++m) {
    EXPECT_LT((merged[m].shape - again[m].shape).norm(), 1e-9);
    EXPECT_NEAR(merged[m].frequency_Hz, again[m].frequency_Hz, 1e-9);
    EXPECT_EQ(merged[m].members.size(), 3U);
    const Eigen::MatrixXcd truth = kChain.shape(static_cast<int>(m)).cast<std::complex<double>>();
    EXPECT_GT(modal::mac(truth, Eigen::MatrixXcd(merged[m].shape))(0, 0), 0.995);
    EXPECT_LT(std::abs(merged[m].frequency_Hz - kChain.frequency_Hz(static_cast<int>(m))),
              4.0 * merged[m].deviation.frequency_Hz);
  }
}

TEST(MergePoser, AModeOfOneSetupIsKeptAndMarked) {
  std::vector<SetupModes> setups = {identified(0, 1.0), identified(1, 1.0)};
  setups[1].modes.erase(setups[1].modes.begin() + 1);
  setups[1].deviations.erase(setups[1].deviations.begin() + 1);
  const auto merged = merge_poser(setups, 5, {0, 3}, {});
  ASSERT_EQ(merged.size(), setups[0].modes.size());
  EXPECT_EQ(merged[1].members.size(), 1U);
  EXPECT_NEAR(merged[1].frequency_Hz, setups[0].modes[1].frequency_Hz, 1e-12);
  EXPECT_TRUE(std::isnan(merged[1].shape[2].real()));  // channel 2 is of the setup that did not see it
  EXPECT_TRUE(std::isnan(merged[0].shape[4].real()));  // channel 4 of none
  EXPECT_FALSE(std::isnan(merged[1].shape[1].real()));
}

// Within half a bandwidth poles of one shape are one mode, also where that is more than the 2 % of a lightly damped one.
TEST(MergePoser, ADampedModeIsOneWithinHalfItsBandwidth) {
  const auto merged_with = [&](double damping_ratio) {
    std::vector<SetupModes> setups = {identified(0, 1.0), identified(1, 1.0)};
    for (SetupModes& setup : setups) setup.modes[1].damping_ratio = damping_ratio;
    setups[1].modes[1].frequency_Hz *= 1.03;
    return merge_poser(setups, 5, {0, 3}, {}).size();
  };
  EXPECT_EQ(merged_with(0.04), identified(0, 1.0).modes.size());
  EXPECT_EQ(merged_with(0.01), identified(0, 1.0).modes.size() + 1);
}

// References that hardly move settle neither sign nor scale of the other setup: its own channel stays unknown.
TEST(MergePoser, WhereTheReferencesAreQuietTheShapeIsNotPutTogether) {
  std::vector<SetupModes> setups = {identified(0, 1.0), identified(1, 1.0)};
  for (SetupModes& setup : setups) {
    Cluster& mode = setup.modes[1];
    mode.shape[0] = 0.01;
    mode.shape[1] = -0.01;
    mode.shape.normalize();
  }
  const auto merged = merge_poser(setups, 5, {0, 3}, {});
  ASSERT_EQ(merged.size(), setups[0].modes.size());
  EXPECT_EQ(merged[1].members.size(), 2U);
  // One setup stands for it: channel 1 is of the first, channel 2 of the other.
  EXPECT_NE(std::isnan(merged[1].shape[1].real()), std::isnan(merged[1].shape[2].real()));
  EXPECT_FALSE(std::isnan(merged[0].shape[2].real()));
}

// Two of three setups know the scale: together they give the shape, and the third one's own channel stays unknown.
TEST(MergePoser, ASetupWithQuietReferencesLeavesTheOthersTheirShape) {
  for (std::size_t quiet = 0; quiet < 3; ++quiet) {
    std::vector<SetupModes> setups = {identified(0, 1.0), identified(1, 1.0), identified(2, 1.0)};
    Cluster& mode = setups[quiet].modes[1];
    mode.shape = Eigen::Vector3cd(0.01, -0.01, 1.0).normalized();
    const MergedMode merged = merge_poser(setups, 5, {0, 3}, {})[1];
    ASSERT_EQ(merged.members.size(), 3U);
    EXPECT_TRUE(std::isnan(merged.shape[kSetups[quiet][2]].real()));
    std::vector<Eigen::Index> known;
    for (Eigen::Index i = 0; i < 5; ++i) {
      if (i != kSetups[quiet][2]) known.push_back(i);
    }
    EXPECT_NEAR(merged.shape(known).norm(), 1.0, 1e-9);
    const Eigen::MatrixXcd truth = kChain.shape(1)(known).cast<std::complex<double>>();
    EXPECT_GT(modal::mac(truth, Eigen::MatrixXcd(merged.shape(known)))(0, 0), 0.99);
  }
}

TEST(MergePoser, ASetupWithoutTheReferenceIsRefused) {
  std::vector<SetupModes> setups = {identified(0, 1.0), identified(1, 1.0)};
  setups[1].channels = {0, 4, 2};
  EXPECT_THROW(static_cast<void>(merge_poser(setups, 5, {0, 3}, {})), InputError);
  EXPECT_THROW(static_cast<void>(merge_poser(setups, 5, {}, {})), InputError);
}

TEST(MergePreger, AgreesWithPoserWhateverTheSetupsGains) {
  std::vector<SetupCorrelations> setups;
  for (std::size_t s = 0; s < 3; ++s) setups.push_back({"S", kSetups[s], {0, 1}, blocks_of(s, s == 1 ? 3.0 : 1.0).mean()});
  const std::vector<int> orders = {10, 12, 14, 16, 18, 20};
  const auto poles = merge_preger(setups, 5, 25, orders, 20.0);
  for (int r = 0; r < 3; ++r) {
    double best = 0.0, frequency = 0.0;
    const Eigen::MatrixXcd truth = kChain.shape(r).cast<std::complex<double>>();
    for (const Pole& pole : poles.back()) {
      if (std::abs(pole.frequency_Hz / kChain.frequency_Hz(r) - 1.0) > 0.01) continue;
      const double mac = modal::mac(truth, Eigen::MatrixXcd(pole.shape))(0, 0);
      if (mac > best) frequency = pole.frequency_Hz;
      best = std::max(best, mac);
    }
    EXPECT_GT(best, 0.99) << r;
    EXPECT_NEAR(frequency / kChain.frequency_Hz(r), 1.0, 0.005);
  }
}

}  // namespace
}  // namespace twindeck::identification
