#include "matching/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "matching/pairing_account.hpp"
#include "unit/matching/measured_modes.hpp"

namespace twindeck::matching {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::SpringChain;

const Place kList{"study.toml", 7, "pairs"};

/// Shape of mode j of a chain at its masses `mass`, both from 1: sin(j pi i / (n + 1)).
VectorXd chain_shape(int n, int j, const std::vector<int>& mass) {
  VectorXd shape(std::ssize(mass));
  for (Index i = 0; i < shape.size(); ++i)
    shape[i] = std::sin(j * std::numbers::pi * mass[static_cast<std::size_t>(i)] / (n + 1));
  return shape;
}

std::vector<std::string> names_of(const std::vector<int>& mass) {
  std::vector<std::string> names;
  for (const int each : mass) names.push_back(std::to_string(each));
  return names;
}

// Oracle: the definition. The i-th measured mode has the i-th computed one, as far as both lists reach, and no MAC.
TEST(PairByOrder, ReachesAsFarAsBothLists) {
  const Measured measured = measured_frequencies(Eigen::Vector3d(1.0, 2.0, 3.0));
  for (const Index computed : {2, 3, 5}) {
    const Pairing pairing = pair_by_order(measured, computed);
    EXPECT_EQ(pairing.method, "order");
    ASSERT_EQ(std::ssize(pairing.pairs), std::min<Index>(3, computed));
    for (Index i = 0; i < std::ssize(pairing.pairs); ++i) {
      const ModePair& pair = pairing.pairs[static_cast<std::size_t>(i)];
      EXPECT_EQ(pair.experimental, i);
      EXPECT_EQ(pair.numerical, i);
      EXPECT_TRUE(std::isnan(pair.mac));
    }
  }
}

// Oracle: the definition. Order is that of frequencies; in which rows they stand says nothing.
TEST(PairByOrder, GoesByFrequencyAndNotByRow) {
  const Pairing pairing =
      pair_by_order(measured_frequencies(Eigen::Vector4d(3.0, 4.0, 1.0, 2.0)), 3, {true, true, false, true});
  ASSERT_EQ(pairing.pairs.size(), 2U);  // 2X, the fourth, has no partner among three; 3X is left out
  EXPECT_EQ(pairing.pairs[0].experimental, 0);
  EXPECT_EQ(pairing.pairs[0].numerical, 2);
  EXPECT_EQ(pairing.pairs[1].experimental, 3);
  EXPECT_EQ(pairing.pairs[1].numerical, 1);
}

// Oracle: the definition. A mode that is left out does not shift the partners of those after it.
TEST(PairByOrder, KeepsThePartnersOfTheOthers) {
  const Pairing pairing = pair_by_order(measured_frequencies(Eigen::Vector3d(1.0, 2.0, 3.0)), 3, {true, false, true});
  ASSERT_EQ(pairing.pairs.size(), 2U);
  EXPECT_EQ(pairing.pairs[1].experimental, 2);
  EXPECT_EQ(pairing.pairs[1].numerical, 2);
}

// Oracle: the list itself, read by eye: pairs come in the order of the measured modes, numbers count from 1.
TEST(PairAsPublished, SortsByMeasuredModeAndPassesOverOthers) {
  const Measured measured = measured_frequencies(Eigen::Vector3d(1.0, 2.0, 3.0));
  const Pairing pairing = pair_as_published(measured, 8, {"3X-2N", "7X-1N", "1X-8N"}, kList);
  EXPECT_EQ(pairing.method, "published");
  ASSERT_EQ(pairing.pairs.size(), 2U);
  EXPECT_EQ(pairing.pairs[0].experimental, 0);
  EXPECT_EQ(pairing.pairs[0].numerical, 7);
  EXPECT_EQ(pairing.pairs[1].experimental, 2);
  EXPECT_EQ(pairing.pairs[1].numerical, 1);
  EXPECT_TRUE(std::isnan(pairing.pairs[0].mac));
  EXPECT_EQ(pairing.unmeasured, std::vector<std::string>{"7X"});
}

// Oracle: the header names what is refused.
TEST(PairAsPublished, RefusesWrongLists) {
  const Measured measured = measured_frequencies(Eigen::Vector3d(1.0, 2.0, 3.0));
  for (const std::vector<std::string>& list :
       std::vector<std::vector<std::string>>{{"1X:1N"}, {"1X-0N"}, {"1X-1N", "1X-2N"}, {"1X-1N", "2X-1N"}, {"1X-4N"}}) {
    EXPECT_THROW((void)pair_as_published(measured, 3, list, kList), InputError) << list.back();
  }
  try {
    (void)pair_as_published(measured, 3, {"1X-4N"}, kList);
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().line, 7);
    EXPECT_TRUE(says(error.what(), "raise n_modes"));
  }
}

// Oracle: closed form. Measured shapes are sines of the chain in another order and scale. Their MAC with every computed mode is
// that of the sines at the sensors. 1e-9: the solver's shapes are good to 1e-10 or so.
TEST(PairAtSensors, MeetsTheClosedFormsOfAChain) {
  const SpringChain chain{.n = 10};
  const std::vector<int> mass = {1, 3, 4, 6, 9};
  const dynamics::LoadedModel model = matrix_model(chain.system());
  const dynamics::EigenModes modes = dynamics::available_modes(model.system, model.theta, 4);
  Eigen::MatrixXcd shapes(5, 2);
  shapes << -3.0 * chain_shape(10, 3, mass), 0.2 * chain_shape(10, 2, mass);
  const Eigen::Vector2d f(1.1 * chain.frequency_Hz(3), 0.9 * chain.frequency_Hz(2));
  const Pairing pairing = pair_at_sensors(measured_shapes(f, shapes, names_of(mass)), model, modes, {}, 0.1);
  EXPECT_EQ(pairing.method, "mac");
  ASSERT_EQ(pairing.mac.rows(), 4);
  ASSERT_EQ(pairing.mac.cols(), 2);
  for (int j = 1; j <= 4; ++j) {
    const VectorXd sine = chain_shape(10, j, mass);
    EXPECT_NEAR(pairing.mac(j - 1, 0), mac_by_hand(sine, shapes.col(0).real()), 1e-9) << j;
    EXPECT_NEAR(pairing.mac(j - 1, 1), mac_by_hand(sine, shapes.col(1).real()), 1e-9) << j;
    // Mass-normalised: m sum sin² = m (n + 1)/2 at all masses.
    const double scale = std::sqrt(2.0 / (chain.m * 11.0));
    EXPECT_NEAR((pairing.shapes.col(j - 1).real().cwiseAbs() - scale * sine.cwiseAbs()).norm(), 0.0, 1e-8) << j;
  }
  ASSERT_EQ(pairing.pairs.size(), 2U);
  EXPECT_EQ(pairing.pairs[0].numerical, 2);
  EXPECT_EQ(pairing.pairs[1].numerical, 1);
  EXPECT_NEAR(pairing.pairs[0].mac, 1.0, 1e-9);
}

// Oracle: closed form. The sensors stand on the first of two chains alone; the second is 1.3 times as stiff. Modes go by turns
// (f1, 1.14 f1, f2, 1.14 f2), so that the measured ones are the computed modes 1 and 3, and modes 2 and 4 have no MAC.
TEST(PairAtSensors, PassesOverModesThatNoSensorSees) {
  const SpringChain chain{.n = 5, .copies = 2};
  const std::vector<int> mass = {1, 2, 4};
  const dynamics::LoadedModel model = matrix_model(chain.system(), {chain.k, chain.m, 1.0, 1.3});
  const dynamics::EigenModes modes = dynamics::available_modes(model.system, model.theta, 4);
  Eigen::MatrixXcd shapes(3, 2);
  shapes << chain_shape(5, 1, mass), chain_shape(5, 2, mass);
  const Eigen::Vector2d f(chain.frequency_Hz(1), chain.frequency_Hz(2));
  const Pairing pairing = pair_at_sensors(measured_shapes(f, shapes, names_of(mass)), model, modes, {}, 0.1);
  ASSERT_EQ(pairing.pairs.size(), 2U);
  EXPECT_EQ(pairing.pairs[0].numerical, 0);
  EXPECT_EQ(pairing.pairs[1].numerical, 2);
  EXPECT_NEAR(pairing.pairs[1].mac, 1.0, 1e-9);
  EXPECT_EQ(pairing.mac.row(1).norm() + pairing.mac.row(3).norm(), 0.0);
  EXPECT_NEAR(pairing.mac(2, 1), 1.0, 1e-9);
}

// Oracle: the definition. At one sensor any shape agrees: no MAC is claimed, and the summary says how the modes were paired.
TEST(PairAtSensors, ClaimsNoMacAtOneSensor) {
  const SpringChain chain{.n = 5};
  const dynamics::LoadedModel model = matrix_model(chain.system());
  const dynamics::EigenModes modes = dynamics::available_modes(model.system, model.theta, 3);
  const Eigen::Vector2d f(1.02 * chain.frequency_Hz(1), 0.97 * chain.frequency_Hz(2));
  const Measured measured = measured_shapes(f, Eigen::MatrixXcd::Ones(1, 2), {"2"});
  const Pairing pairing = pair_at_sensors(measured, model, modes, {}, 0.1);
  ASSERT_EQ(pairing.pairs.size(), 2U);
  EXPECT_EQ(pairing.pairs[0].numerical, 0);
  EXPECT_EQ(pairing.pairs[1].numerical, 1);
  EXPECT_TRUE(std::isnan(pairing.pairs[0].mac));
  EXPECT_TRUE(pairing.mac.array().isNaN().all());
  const PairingAccount account = account_of(measured, pairing, modes.frequency_Hz);
  EXPECT_EQ(account.shapeless, (std::vector<std::string>{"1X-1N", "2X-2N"}));
  EXPECT_TRUE(says(pairing_words(account), "2 paired by frequency"));
  HeardReporter heard;
  warn_of_pairing(heard, account, std::nullopt, "");
  ASSERT_EQ(heard.warned.size(), 1U);
  EXPECT_TRUE(says(heard.warned[0], "1X-1N, 2X-2N: measured at one channel alone"));
}

// Oracle: the header. Without shapes there is no MAC to pair by.
TEST(PairAtSensors, RefusesModesWithoutShapes) {
  const dynamics::LoadedModel model = matrix_model(SpringChain{.n = 4}.system());
  const dynamics::EigenModes modes = dynamics::available_modes(model.system, model.theta, 2);
  EXPECT_THROW((void)pair_at_sensors(measured_frequencies(Eigen::Vector2d(1, 2)), model, modes, {}, 0.1), InputError);
}

// Oracle: the header. Lists are checked where no shape was measured, places of channels where one was.
TEST(CheckPairing, RefusesBeforeAnythingIsSolved) {
  dynamics::ReadModel model;
  model.matrices = SpringChain{.n = 4}.system();
  const Measured bare = measured_frequencies(Eigen::Vector2d(1, 2));
  EXPECT_NO_THROW(check_pairing(bare, model, {"1X-3N"}, kList, 3, 0.1));
  EXPECT_THROW(check_pairing(bare, model, {"1X-4N"}, kList, 3, 0.1), InputError);
  const Eigen::MatrixXcd shapes = Eigen::MatrixXcd::Ones(1, 2);
  EXPECT_NO_THROW(check_pairing(measured_shapes(bare.modes.frequency_Hz, shapes, {"4"}), model, {}, kList, 3, 0.1));
  EXPECT_THROW(check_pairing(measured_shapes(bare.modes.frequency_Hz, shapes, {"5"}), model, {}, kList, 3, 0.1), InputError);
}

// Oracle: grammar. One warning that names each mode; none where nothing was passed over.
TEST(WarnOfUnmeasured, NamesThePassedOver) {
  HeardReporter warnings;
  warn_of_unmeasured(warnings, {});
  EXPECT_TRUE(warnings.warned.empty());
  Pairing pairing;
  pairing.unmeasured = {"7X"};
  warn_of_unmeasured(warnings, pairing);
  pairing.unmeasured = {"7X", "9X"};
  warn_of_unmeasured(warnings, pairing);
  ASSERT_EQ(warnings.warned.size(), 2U);
  EXPECT_TRUE(says(warnings.warned[0], "7X is not"));
  EXPECT_TRUE(says(warnings.warned[1], "7X, 9X are not"));
}

// Oracle: hand calculation of (f_N - f_X)/f_X. 2.1 against 2.0 Hz is +5 %, 3.88 against 4.0 Hz is -3 %; the mean of the
// magnitudes is 4 %.
TEST(Compare, GivesSignedErrorsOfThePairs) {
  const Measured measured = measured_frequencies(Eigen::Vector3d(2.0, 3.0, 4.0));
  Pairing pairing;
  pairing.method = "mac";
  pairing.pairs = {{0, 2, 0.9, false}, {2, 0, kUnknown, false}};
  std::vector<ComparisonRow> rows = compare("start", measured, Eigen::Vector3d(3.88, 7.0, 2.1), pairing);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].experimental, "1X");
  EXPECT_EQ(rows[0].numerical, "3N");
  EXPECT_EQ(rows[0].pairing, "mac");
  EXPECT_EQ(rows[0].mac, 0.9);
  EXPECT_NEAR(rows[0].error_pct(), 5.0, 1e-12);
  EXPECT_EQ(rows[1].experimental, "3X");
  EXPECT_EQ(rows[1].mac, std::nullopt);
  EXPECT_NEAR(rows[1].error_pct(), -3.0, 1e-12);
  rows.push_back({"updated", "1X", "1N", 1.0, 2.0, std::nullopt, "mac"});
  EXPECT_NEAR(mean_abs_error_pct(rows, "start"), 4.0, 1e-12);
  EXPECT_NEAR(mean_abs_error_pct(rows, "updated"), 100.0, 1e-12);
  EXPECT_TRUE(std::isnan(mean_abs_error_pct(rows, "other")));
}

}  // namespace
}  // namespace twindeck::matching
