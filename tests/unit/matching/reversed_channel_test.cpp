#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <utility>

#include "matching/pairing_account.hpp"
#include "unit/matching/measured_modes.hpp"

namespace twindeck::matching {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Sines at `n` channels of a beam, orthogonal to each other.
MatrixXd beam_shapes(Index n = 6, Index modes = 3) {
  MatrixXd phi(n, modes);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < modes; ++j)
      phi(i, j) = std::sin(std::numbers::pi * static_cast<double>((i + 1) * (j + 1)) / static_cast<double>(n + 1));
  return phi;
}

/// Each measured mode paired with the computed one of its number.
std::optional<std::string> found(const Eigen::MatrixXcd& measured, const Eigen::MatrixXcd& computed) {
  Pairing pairing;
  pairing.method = "mac";
  pairing.shapes = computed;
  for (Index i = 0; i < measured.cols(); ++i) pairing.pairs.push_back({i, i, 1.0, false});
  const std::vector<std::string> points(static_cast<std::size_t>(measured.rows()), "p");
  return reversed_channel(measured_shapes(Eigen::VectorXd::Ones(measured.cols()), measured, points), pairing);
}

// Oracle: by construction. One channel at a time is turned; that one is named, with the mean MAC of the definition before and
// a MAC of one after.
TEST(ReversedChannel, NamesTheOneThatWasTurned) {
  const MatrixXd computed = beam_shapes();
  for (Index turned = 0; turned < computed.rows(); ++turned) {
    MatrixXd measured = computed;
    measured.row(turned) *= -1.0;
    double mean = 0.0;
    for (Index i = 0; i < 3; ++i) mean += mac_by_hand(measured.col(i), computed.col(i)) / 3.0;
    char as_recorded[64];
    std::snprintf(as_recorded, sizeof as_recorded, "of 3 pairs is 1.00, as recorded it is %.2f", mean);
    const std::optional<std::string> sentence = found(measured, computed);
    ASSERT_TRUE(sentence.has_value()) << turned;
    EXPECT_TRUE(says(*sentence, "channel c" + std::to_string(turned + 1) + " seems"));
    EXPECT_TRUE(says(*sentence, as_recorded));
  }
}

// Oracle: invariance. The MAC does not depend on scale and phase of a shape, of either side.
TEST(ReversedChannel, DoesNotDependOnScaleOrPhase) {
  const Eigen::MatrixXcd computed = beam_shapes();
  Eigen::MatrixXcd measured = computed, turned = computed;
  measured.row(3) *= -1.0;
  const std::optional<std::string> plain = found(measured, computed);
  for (Index i = 0; i < 3; ++i) {
    measured.col(i) *= std::polar(0.3 + static_cast<double>(i), 0.7 + static_cast<double>(i));
    turned.col(i) *= std::polar(2.0, 0.4 - static_cast<double>(i));
  }
  ASSERT_TRUE(plain.has_value());
  EXPECT_EQ(found(measured, turned), plain);
}

// Oracle: by construction. A mode that was not measured at some channels is compared over the others.
TEST(ReversedChannel, PassesOverChannelsWithoutAReading) {
  const MatrixXd computed = beam_shapes();
  MatrixXd measured = computed;
  measured.row(4) *= -1.0;
  measured(0, 0) = measured(2, 1) = std::nan("");
  const std::optional<std::string> sentence = found(measured, computed);
  ASSERT_TRUE(sentence.has_value());
  EXPECT_TRUE(says(*sentence, "channel c5 seems"));
  EXPECT_TRUE(says(*sentence, "pairs is 1.00"));
}

// Oracle: the header. Sound channels, too few channels and too few pairs give nothing.
TEST(ReversedChannel, IsSilentWhereNothingCanBeTold) {
  const MatrixXd computed = beam_shapes();
  MatrixXd measured = computed;
  EXPECT_EQ(found(measured, computed), std::nullopt);
  measured.row(2) *= -1.0;
  EXPECT_TRUE(found(measured.leftCols(2), computed).has_value());
  EXPECT_EQ(found(measured.leftCols(1), computed), std::nullopt);
  const MatrixXd few = beam_shapes(3, 2);
  MatrixXd few_turned = few;
  few_turned.row(1) *= -1.0;
  EXPECT_EQ(found(few_turned, few), std::nullopt);
}

// Oracle: hand calculation. Turning a channel that holds a share s of a shape's square takes 1 - (1 - 2 s)² = 4 s (1 - s) off
// the MAC. The source asks for 0.05: s = 0.0127. Shares of 0.01 and 0.02 lie on either side.
TEST(ReversedChannel, IsSilentWhereTheChannelHardlyMoves) {
  for (const auto& [share, expected] : {std::pair{0.01, false}, std::pair{0.02, true}}) {
    MatrixXd computed(4, 2);
    computed << 1, 1, 1, -1, 1, -1, 0, 0;
    computed.row(3).setConstant(std::sqrt(3.0 * share / (1.0 - share)));
    MatrixXd measured = computed;
    measured.row(3) *= -1.0;
    EXPECT_NEAR(1.0 - mac_by_hand(measured.col(0), computed.col(0)), 4.0 * share * (1.0 - share), 1e-12);
    EXPECT_EQ(found(measured, computed).has_value(), expected) << share;
  }
}

// Oracle: by construction. Where two channels are turned, turning one of them leaves more than a third of what is lacking: with
// equal readings at six channels the MAC is (2/6)² = 0.11, and (4/6)² = 0.44 with one of them turned.
TEST(ReversedChannel, IsSilentWhereOneChannelDoesNotExplainIt) {
  const MatrixXd computed = MatrixXd::Ones(6, 2);
  MatrixXd measured = computed;
  measured.topRows(1) *= -1.0;
  EXPECT_TRUE(found(measured, computed).has_value());
  measured.topRows(2).setConstant(-1.0);
  EXPECT_EQ(found(measured, computed), std::nullopt);
}

}  // namespace
}  // namespace twindeck::matching
