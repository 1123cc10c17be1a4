#include "matching/pairing_account.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "unit/matching/measured_modes.hpp"

namespace twindeck::matching {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Pairing by_shape(std::vector<ModePair> pairs) {
  Pairing pairing;
  pairing.method = "mac";
  pairing.pairs = std::move(pairs);
  return pairing;
}

/// Five modes of which three are paired; the third lies below the highest computed mode (6 Hz), the fifth above it.
PairingAccount three_of_five() {
  VectorXd measured(5), computed(6);
  measured << 1, 2, 3, 4, 9;
  computed << 1, 2, 3, 4, 5, 6;
  return account_of(measured_frequencies(measured), by_shape({{0, 0, 0.95, false}, {1, 1, 0.304, false}, {3, 4, 0.6, false}}),
                    computed);
}

// Oracle: counted by hand.
TEST(AccountOf, CountsPairedUnpairedAndUnreached) {
  const PairingAccount account = three_of_five();
  EXPECT_TRUE(account.by_shape);
  EXPECT_EQ(account.measured, 4);
  EXPECT_EQ(account.paired(), 3);
  EXPECT_EQ(account.unpaired, std::vector<std::string>{"3X"});
  EXPECT_EQ(account.beyond, std::vector<std::string>{"5X"});
  EXPECT_EQ(account.worst_mac, 0.304);
  EXPECT_EQ(account.worst, "2X-2N");
  EXPECT_EQ(account.unlike, std::vector<std::string>{"2X-2N (MAC 0.30)"});
  EXPECT_EQ(account.reversed, std::nullopt);
}

// Oracle: the definitions. A mode above the highest computed one counts if it is paired; a MAC of just one half is no
// disagreement.
TEST(AccountOf, HoldsAtItsLimits) {
  const PairingAccount account = account_of(measured_frequencies(Eigen::Vector3d(1.0, 2.0, 2.1)),
                                            by_shape({{2, 1, agreeing_mac, false}}), Eigen::Vector2d(1.5, 2.0));
  EXPECT_EQ(account.measured, 3);  // the second lies just at the highest
  EXPECT_EQ(account.paired(), 1);
  EXPECT_TRUE(account.beyond.empty());
  EXPECT_TRUE(account.unlike.empty());
  EXPECT_EQ(account.worst, "3X-2N");
}

// Oracle: the header. A pairing by order has no MAC, and nothing is said of shapes.
TEST(AccountOf, KnowsNoShapesOfAPairingByOrder) {
  const Measured measured = measured_frequencies(Eigen::Vector2d(1.0, 2.0));
  const PairingAccount account = account_of(measured, pair_by_order(measured, 2), Eigen::Vector2d(1.0, 2.0));
  EXPECT_FALSE(account.by_shape);
  EXPECT_EQ(account.paired(), 2);
  EXPECT_TRUE(std::isnan(account.worst_mac));
  EXPECT_EQ(account.worst, "");
  EXPECT_EQ(pairing_words(account), "");
  EXPECT_NO_THROW(refuse_few_pairs(account, 1.0, 0.2, "measured", std::nullopt));
}

// Oracle: the example of the header, and the sentence for the account above.
TEST(PairingWords, SayWhatTheAccountHolds) {
  PairingAccount account;
  account.by_shape = true;
  account.measured = 9;
  account.unpaired = {"7X", "9X"};
  account.worst_mac = 0.43;
  account.worst = "5X-6N";
  EXPECT_EQ(pairing_words(account), "; 2 of 9 measured modes unpaired, worst MAC 0.43 (5X-6N)");
  EXPECT_EQ(pairing_words(three_of_five()),
            "; 1 of 4 measured modes unpaired, 1 above the highest computed, worst MAC 0.30 (2X-2N); WARNING: shapes disagree");
}

// Oracle: the header. Only a run that converged is marked, and of many pairs the first six are named.
TEST(Outcome, MarksARunWhoseShapesDisagree) {
  EXPECT_EQ(outcome({true, "fine"}, {}).message, "fine");
  PairingAccount account = three_of_five();
  const Status marked = outcome({true, "fine"}, account);
  EXPECT_TRUE(marked.converged);
  EXPECT_EQ(marked.message, "shapes disagree: 2X-2N (MAC 0.30)");
  EXPECT_EQ(outcome({false, "stopped"}, account).message, "stopped");
  account.unlike = {"1", "2", "3", "4", "5", "6"};
  EXPECT_EQ(outcome({}, account).message, "shapes disagree: 1, 2, 3, 4, 5, 6");
  account.unlike.push_back("7");
  account.unlike.push_back("8");
  EXPECT_EQ(outcome({}, account).message, "shapes disagree: 1, 2, 3, 4, 5, 6 and 2 more");
}

/// The sentence for four modes of equal shapes, if computed frequencies are `ratio` times the measured ones, each off by `off`.
std::optional<std::string> factor_of(double ratio, const Eigen::Vector4d& off = Eigen::Vector4d::Ones()) {
  const Eigen::Vector4d measured(1.0, 1.7, 2.9, 4.1);
  Pairing pairing = by_shape({});
  pairing.mac = MatrixXd::Identity(4, 4);
  return common_factor(measured_frequencies(measured), pairing, ratio * measured.cwiseProduct(off));
}

// Oracle: f ~ sqrt(stiffness/mass), so that a number of stiffness that is too large by a, and of mass by b, multiplies computed
// frequencies by sqrt(a/b); a unit of the measured frequencies divides the ratio by itself.
TEST(CommonFactor, NamesTheSlip) {
  struct Slip {
    double stiffness, mass, measured;
    const char* words;
  };
  const double g = 9.80665, two_pi = 2.0 * std::numbers::pi;
  for (const Slip& slip :
       {Slip{1e-3, 1, 1, "stiffness in kN/m"},               // 1 kN/m is written as 1, and is 1000 N/m
        Slip{1e-3, 1, 1, "or N/mm"},                         // 1 N/mm is 1000 N/m
        Slip{1, 1e6, 1, "mass in milligrams"},               // 1 kg is written as 1e6
        Slip{1, 1e3, 1, "mass in grams"},                    // 1 kg is written as 1000
        Slip{1, 1e-3, 1, "mass in tonnes"},                  // 1000 kg are written as 1
        Slip{1e-6, 1, 1, "modulus of the model in MPa"},     // 1e6 Pa are written as 1
        Slip{1, 1, 1e3, "measured frequencies in mHz"},      // 1 Hz is written as 1000
        Slip{1, 1, 1e-3, "measured frequencies in kHz"},     // 1000 Hz are written as 1
        Slip{1, g, 1, "weight in newtons given as a mass"},  // 1 kg weighs 9.8 N
        Slip{1, 1 / g, 1, "mass divided by g"},              //
        Slip{1, 1, two_pi, "measured frequencies in rad/s"}, Slip{1, 1, 60, "measured frequencies in cycles per minute"}}) {
    const double ratio = std::sqrt(slip.stiffness / slip.mass) / slip.measured;
    for (const double model_error : {0.95, 1.0, 1.05}) {
      const std::optional<std::string> sentence = factor_of(ratio * model_error);
      ASSERT_TRUE(sentence.has_value()) << slip.words;
      EXPECT_TRUE(says(*sentence, slip.words));
    }
  }
}

// Oracle: a mass forgotten by half makes f sqrt(2) as large and stiffness over mass twice; it is no slip of units.
TEST(CommonFactor, SaysTheRatioOfStiffnessToMassOtherwise) {
  const std::optional<std::string> sentence = factor_of(std::sqrt(2.0));
  ASSERT_TRUE(sentence.has_value());
  EXPECT_TRUE(says(*sentence, "of 4 measured modes"));
  EXPECT_TRUE(says(*sentence, "1.41 times the measured (1.41 to 1.41)"));
  EXPECT_TRUE(says(*sentence, "stiffness over mass is 2 times"));
}

// Oracle: the limits that the source states: 10 % between frequencies, a quarter of ln(factor) between single ratios. ln 2 =
// 0.693: a single ratio may be off by exp(0.173) = 1.189 and not by more, up or down.
TEST(CommonFactor, NeedsOneFactorAwayFromOne) {
  EXPECT_EQ(factor_of(1.0), std::nullopt);
  EXPECT_EQ(factor_of(1.09), std::nullopt);
  EXPECT_EQ(factor_of(1.0 / 1.09), std::nullopt);
  EXPECT_TRUE(factor_of(1.11).has_value());
  EXPECT_TRUE(factor_of(1.0 / 1.11).has_value());
  for (const double off : {1.18, 1.0 / 1.18}) EXPECT_TRUE(factor_of(2.0, {1.0, off, 1.0, 1.0}).has_value()) << off;
  for (const double off : {1.20, 1.0 / 1.20}) EXPECT_EQ(factor_of(2.0, {1.0, off, 1.0, 1.0}), std::nullopt) << off;
}

// Oracle: the header. Three measured modes at least, and half of them, must agree by shape; order does not matter.
TEST(CommonFactor, GoesByShapeAlone) {
  const auto with_mac = [](const MatrixXd& mac, const VectorXd& computed) {
    Pairing pairing = by_shape({});
    pairing.mac = mac;
    return common_factor(measured_frequencies(VectorXd::LinSpaced(mac.cols(), 1.0, static_cast<double>(mac.cols()))), pairing,
                         computed);
  };
  MatrixXd exchanged(3, 3);  // rows are computed modes, which are the measured modes 2, 3 and 1
  exchanged << 0, 0.95, 0, 0, 0, 0.95, 0.95, 0, 0;
  EXPECT_TRUE(with_mac(exchanged, Eigen::Vector3d(4.0, 6.0, 2.0)).has_value());
  EXPECT_EQ(with_mac(exchanged, Eigen::Vector3d(2.0, 4.0, 6.0)), std::nullopt);
  EXPECT_EQ(with_mac(0.94 * exchanged, Eigen::Vector3d(4.0, 6.0, 2.0)), std::nullopt);  // MAC 0.893
  EXPECT_EQ(with_mac(MatrixXd::Identity(2, 2), Eigen::Vector2d(2.0, 4.0)), std::nullopt);
  EXPECT_TRUE(with_mac(MatrixXd::Identity(3, 6), Eigen::Vector3d(2.0, 4.0, 6.0)).has_value());
  EXPECT_EQ(with_mac(MatrixXd::Identity(3, 7), Eigen::Vector3d(2.0, 4.0, 6.0)), std::nullopt);
  EXPECT_EQ(with_mac(MatrixXd(0, 0), VectorXd()), std::nullopt);
  // At few channels the first and the fourth computed mode have one shape, the fourth the more so: only the first has the
  // factor.
  MatrixXd repeated = MatrixXd::Identity(5, 3);
  repeated(0, 0) = 0.95, repeated(3, 0) = 0.97;
  const std::optional<std::string> found = with_mac(repeated, (VectorXd(5) << 2.0, 4.0, 6.0, 9.0, 10.0).finished());
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(says(*found, "all 2 times the measured (2 to 2)"));
}

// Oracle: the header. Each of the three findings has a line, and where nothing was found there is none.
TEST(WarnOfPairing, HasALineForEachFinding) {
  HeardReporter none, all;
  warn_of_pairing(none, {}, std::nullopt, "");
  EXPECT_TRUE(none.warned.empty());
  PairingAccount account = three_of_five();
  account.reversed = "channel c4 seems to be reversed";
  warn_of_pairing(all, account, "all are twice the measured", "before the updating");
  ASSERT_EQ(all.warned.size(), 3U);
  EXPECT_EQ(all.warned[0], "all are twice the measured");
  EXPECT_EQ(all.warned[1], "channel c4 seems to be reversed");
  EXPECT_TRUE(says(all.warned[2], "shapes disagree before the updating: 2X-2N (MAC 0.30);"));
}

// Oracle: 3 of 4 modes are paired, a share of 0.75.
TEST(RefuseFewPairs, HoldsAtItsShare) {
  const PairingAccount account = three_of_five();
  EXPECT_NO_THROW(refuse_few_pairs(account, 0.75, 0.2, "measured", std::nullopt));
  try {
    refuse_few_pairs(account, 0.76, 0.2, "measured", "all are twice the measured");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().file, "measured");
    EXPECT_TRUE(says(error.what(), "only 3 of 4 measured modes"));
    EXPECT_TRUE(says(error.what(), "unpaired mode 3X"));
    EXPECT_TRUE(says(error.what(), "all are twice the measured"));
  }
}

// Oracle: counted by hand. If all modes lie above the highest computed one, they are those that are named.
TEST(RefuseFewPairs, NamesModesThatTheModelDoesNotReach) {
  const PairingAccount account =
      account_of(measured_frequencies(Eigen::Vector2d(8.0, 9.0)), by_shape({}), Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(account.measured, 0);
  try {
    refuse_few_pairs(account, 0.5, 0.2, "measured", std::nullopt);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(says(error.what(), "only 0 of 2 measured modes"));
    EXPECT_TRUE(says(error.what(), "unpaired modes 1X, 2X"));
  }
}

// Oracle: hand calculation. The second mode stands twice: 3X is paired with 3N, 5.0/2.1 - 1 = 138 %.
TEST(FarByOrder, NamesPairsThatCannotBeRight) {
  const Measured measured = measured_frequencies(Eigen::Vector3d(1.0, 2.0, 2.1));
  const Eigen::Vector3d computed(1.1, 2.2, 5.0);
  const std::optional<std::string> far = far_by_order(measured, pair_by_order(measured, 3), computed, 0.35);
  ASSERT_TRUE(far.has_value());
  EXPECT_TRUE(says(*far, "3X-3N (+138 %) is further apart"));
  EXPECT_FALSE(far_by_order(measured, pair_by_order(measured, 3), computed, 1.5).has_value());
  // Whoever states the pairs has seen them.
  const Pairing stated = pair_as_published(measured, 3, {"3X-3N"}, {"study.toml", 7, "pairs"});
  EXPECT_FALSE(far_by_order(measured, stated, computed, 0.35).has_value());
}

}  // namespace
}  // namespace twindeck::matching
