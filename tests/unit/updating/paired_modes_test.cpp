// Oracle: two masses between walls whose modes are known in closed form (measured_chain.hpp).
#include "updating/paired_modes.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "measured_chain.hpp"

namespace twindeck::updating {
namespace {

struct Chain {
  dynamics::LoadedModel model = loaded(two_masses());
  dynamics::EigenModes modes = modes_of(model);
  Eigen::Matrix2d shapes = (Eigen::Matrix2d() << 1, 1, 1, -1).finished();
  /// Both modes, the second one first: its frequency was measured below the other's.
  [[nodiscard]] matching::Measured exchanged() const {
    return measured_modes(Eigen::Vector2d(3.1, 3.3), 0.01, shapes.rowwise().reverse(), 0.1);
  }
};

TEST(PairForUpdating, GoesByShapeWhereShapesWereMeasured) {
  const Chain c;
  HeardReporter heard;
  const matching::Pairing pairing = pair_for_updating(heard, {}, c.model, c.modes, c.exchanged());
  ASSERT_EQ(pairing.pairs.size(), 2U);
  EXPECT_EQ(pairing.pairs[0].numerical, 1);
  EXPECT_EQ(pairing.pairs[1].numerical, 0);
  EXPECT_NEAR(pairing.pairs[0].mac, 1.0, 1e-12);
  const std::vector<FrequencyTarget> targets = frequency_targets(c.exchanged(), pairing);
  EXPECT_EQ(targets[0].label, "1X-2N");
  EXPECT_EQ(targets[0].reference_mode, 1);
  EXPECT_EQ(targets[0].measured_Hz, 3.1);
  EXPECT_TRUE(heard.warned.empty());
}

TEST(PairForUpdating, SaysThatAListIsNotUsedWhereShapesWereMeasured) {
  const Chain c;
  HeardReporter heard;
  UpdatingSettings settings;
  EXPECT_EQ(pair_for_updating(heard, settings, c.model, c.modes, c.exchanged()).pairs[0].numerical, 1);
  EXPECT_TRUE(heard.said.empty());
  settings.pairs = {"1X-1N", "2X-2N"};
  EXPECT_EQ(pair_for_updating(heard, settings, c.model, c.modes, c.exchanged()).pairs[0].numerical, 1);
  ASSERT_EQ(heard.said.size(), 1U);
  EXPECT_NE(heard.said[0].find("`pairs` is not used"), std::string::npos);
}

TEST(PairForUpdating, GoesByOrderOrByAListWhereNoShapeWasMeasured) {
  const Chain c;
  HeardReporter heard;
  const matching::Measured measured = measured_frequencies(Eigen::Vector2d(3.2, 3.9), 0.01);
  EXPECT_EQ(pair_for_updating(heard, {}, c.model, c.modes, measured).pairs[1].numerical, 1);
  UpdatingSettings settings;
  settings.pairs = {"1X-2N", "2X-1N", "5X-2N"};
  EXPECT_THROW(static_cast<void>(pair_for_updating(heard, settings, c.model, c.modes, measured)), InputError);  // 2N twice
  settings.pairs = {"1X-2N", "5X-1N"};
  settings.least_paired = 0.4;  // 2X has no partner
  EXPECT_EQ(pair_for_updating(heard, settings, c.model, c.modes, measured).pairs[0].numerical, 1);
  ASSERT_EQ(heard.warned.size(), 1U);
  EXPECT_NE(heard.warned[0].find("5X"), std::string::npos);
}

// The first mode stands twice: 2X is paired with 2N, 3.9/3.2 - 1 = 22 % away. Whoever states that pair has seen it.
TEST(PairForUpdating, WarnsOfPairsByOrderThatAreTooFarApart) {
  const Chain c;
  HeardReporter heard;
  UpdatingSettings settings;
  settings.maximum_frequency_error = 0.2;
  const matching::Measured measured = measured_frequencies(Eigen::Vector2d(3.1, 3.2), 0.01);
  static_cast<void>(pair_for_updating(heard, settings, c.model, c.modes, measured));
  ASSERT_EQ(heard.warned.size(), 1U);
  EXPECT_NE(heard.warned[0].find("2X-2N (+22 %)"), std::string::npos);
  settings.pairs = {"1X-1N", "2X-2N"};
  static_cast<void>(pair_for_updating(heard, settings, c.model, c.modes, measured));
  EXPECT_EQ(heard.warned.size(), 1U);
}

// Both measured frequencies are within what the model computes, and neither is near enough to be paired.
TEST(PairForUpdating, RefusesModesWithoutPartners) {
  const Chain c;
  HeardReporter heard;
  UpdatingSettings settings;
  settings.maximum_frequency_error = 0.1;
  const matching::Measured measured = measured_modes(Eigen::Vector2d(0.5, 0.6), 0.01, c.shapes, 0.1);
  EXPECT_THROW(static_cast<void>(pair_for_updating(heard, settings, c.model, c.modes, measured)), InputError);
  settings.least_paired = 0.0;
  EXPECT_THROW(static_cast<void>(pair_for_updating(heard, settings, c.model, c.modes, measured)), InputError);
}

// After an updating the modes have changed places: the pair follows, and its MAC is that of the mode it followed.
TEST(FollowedPairing, TakesTheModesThatTheUpdatingFollowed) {
  const Chain c;
  HeardReporter heard;
  const matching::Measured measured = measured_modes(c.modes.frequency_Hz, 0.01, c.shapes, 0.1);
  const matching::Pairing before = pair_for_updating(heard, {}, c.model, c.modes, measured);
  UpdatingResult result;
  result.mode_after = {1, 0};
  const matching::Pairing followed = followed_pairing({}, before, result, c.model, c.modes, measured);
  EXPECT_EQ(followed.pairs[0].numerical, 1);
  EXPECT_NEAR(followed.pairs[0].mac, 0.0, 1e-12);  // orthogonal to what was measured
  const matching::PairingAccount account = account_after(heard, followed, c.modes, measured);
  EXPECT_EQ(account.unlike.size(), 2U);
  EXPECT_FALSE(heard.warned.empty());
}

// Oracle: hand calculation. Masses on springs of their own, two of them 0.5 % apart in frequency. The measured shapes are
// theirs turned by 45 degrees: MAC 0.5 with either, subspace MAC 1, before and after alike, whichever of the two was followed.
TEST(FollowedPairing, CountsCloseModesByTheirSubspace) {
  SmallSystem small(3);
  small.stiffness(Eigen::Vector3d(400.0, 404.0, 900.0).asDiagonal()).mass(Eigen::Matrix3d::Identity());
  const dynamics::LoadedModel model = loaded(small);
  const dynamics::EigenModes modes = modes_of(model);
  const Eigen::MatrixXd shapes = (Eigen::MatrixXd(3, 2) << 1, 1, 1, -1, 0, 0).finished();
  const matching::Measured measured = measured_modes(modes.frequency_Hz.head(2), 0.01, shapes, 0.1);
  HeardReporter heard;
  const matching::Pairing before = pair_for_updating(heard, {}, model, modes, measured);
  for (const std::vector<int>& after : {std::vector<int>{0, 1}, std::vector<int>{1, 0}}) {
    UpdatingResult result;
    result.mode_after = after;
    const matching::Pairing followed = followed_pairing({}, before, result, model, modes, measured);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(before.pairs.at(i).mac, 1.0, 1e-12);
      EXPECT_NEAR(followed.pairs.at(i).mac, 1.0, 1e-12);
      EXPECT_TRUE(followed.pairs.at(i).clustered);
    }
    EXPECT_TRUE(account_after(heard, followed, modes, measured).unlike.empty());
  }
  EXPECT_TRUE(heard.warned.empty());
}

TEST(FollowedPairing, KeepsUnknownMacWithoutShapes) {
  const Chain c;
  HeardReporter heard;
  const matching::Measured measured = measured_frequencies(c.modes.frequency_Hz, 0.01);
  UpdatingResult result;
  result.mode_after = {1, 0};
  const matching::Pairing before = pair_for_updating(heard, {}, c.model, c.modes, measured);
  EXPECT_TRUE(std::isnan(followed_pairing({}, before, result, c.model, c.modes, measured).pairs[0].mac));
}

// Errors of 10 % and -20 % before, 1 % and 0 % after: means of 15 % and 0.5 %.
TEST(SummaryLine, TellsMeanErrors) {
  const std::vector<matching::ComparisonRow> rows = {{"before", "1X", "1N", 2.0, 2.2, {}, "order"},
                                                     {"before", "2X", "2N", 5.0, 4.0, {}, "order"},
                                                     {"after", "1X", "1N", 2.0, 2.02, {}, "order"},
                                                     {"after", "2X", "2N", 5.0, 5.0, {}, "order"}};
  EXPECT_EQ(summary_line(rows, {}), "mean |error| of 2 pairs: 15.00 % before, 0.50 % after");
}

TEST(PrestressRefresh, IsEmptyForAModelOfMatrices) { EXPECT_FALSE(prestress_refresh(loaded(two_masses()))); }

}  // namespace
}  // namespace twindeck::updating
