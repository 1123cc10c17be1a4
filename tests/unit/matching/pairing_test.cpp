#include "matching/pairing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pair_by_mac.hpp"

namespace {

using twindeck::pair_by_mac;
using twindeck::matching::ModePair;

/// Orthogonal shapes at six sensors.
Eigen::MatrixXcd shapes(int n) { return Eigen::MatrixXcd::Identity(6, n) * 2.0; }

// Oracle: by construction. The measured modes are the computed ones in another order and scale.
TEST(PairByMac, FindsModesThatChangedOrder) {
  const Eigen::Vector3d f_n(1.0, 1.2, 1.5);
  const Eigen::Vector2d f_x(1.05, 1.25);
  const Eigen::MatrixXcd phi_n = shapes(3);
  Eigen::MatrixXcd phi_x(6, 2);
  phi_x << -3.0 * phi_n.col(2), 0.1 * phi_n.col(0);
  const std::vector<ModePair> pairs = pair_by_mac(f_x, phi_x, f_n, phi_n, {.maximum_frequency_error = 0.6});
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].numerical, 2);
  EXPECT_EQ(pairs[1].numerical, 0);
  EXPECT_NEAR(pairs[0].mac, 1.0, 1e-12);
  EXPECT_FALSE(pairs[0].clustered);
}

// Oracle: by construction. Each measured mode lacks other sensors; over those that it has it is a computed mode in another
// order.
TEST(PairByMac, ComparesEachModeOverItsOwnSensors) {
  const Eigen::Vector2d f(1.0, 1.2);
  Eigen::MatrixXcd phi_n(4, 2);
  phi_n << 1, 1, 2, -1, 3, 2, 4, -3;
  Eigen::MatrixXcd phi_x(4, 2);
  phi_x << -2.0 * phi_n.col(1), 0.5 * phi_n.col(0);
  phi_x(0, 0) = std::nan("");
  phi_x(3, 1) = std::nan("");
  const std::vector<ModePair> pairs = pair_by_mac(f, phi_x, f, phi_n);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].numerical, 1);
  EXPECT_EQ(pairs[1].numerical, 0);
  EXPECT_NEAR(pairs[0].mac, 1.0, 1e-12);
  EXPECT_NEAR(pairs[1].mac, 1.0, 1e-12);
  // With zeros in place of what is missing neither would be whole.
  EXPECT_LT(pair_by_mac(f, phi_x.array().isNaN().select(0.0, phi_x.array()).matrix(), f, phi_n)[0].mac, 0.99);
}

// Oracle: the contract. Too far in frequency, or too unlike: no pair.
TEST(PairByMac, LeavesOutWhatIsNotAdmissible) {
  const Eigen::MatrixXcd phi = shapes(1);
  const Eigen::VectorXd one = Eigen::VectorXd::Constant(1, 1.0), far = Eigen::VectorXd::Constant(1, 1.5);
  EXPECT_EQ(pair_by_mac(one, phi, far, phi).size(), 0U);
  EXPECT_EQ(pair_by_mac(one, phi, far, phi, {.maximum_frequency_error = 0.6}).size(), 1U);
  Eigen::MatrixXcd mixed = phi;
  mixed(3, 0) = 2.0;
  EXPECT_EQ(pair_by_mac(one, mixed, one, phi, {.minimum_mac = 0.6}).size(), 0U);
}

// Oracle: hand calculation. MACs are 0.6 and 0.4 of the first measured mode, 0.3 and 0 of the second. The largest sum, 0.4 +
// 0.3, is made of pairs that are both too unlike to be kept; the good pair must not be crowded out by them.
TEST(PairByMac, UnlikePairsDoNotCrowdOutAGoodOne) {
  const Eigen::MatrixXcd phi_n = shapes(2);
  Eigen::MatrixXcd phi_x = Eigen::MatrixXcd::Zero(6, 2);
  phi_x.col(0) << std::sqrt(0.6), std::sqrt(0.4), 0.0, 0.0, 0.0, 0.0;
  phi_x.col(1) << std::sqrt(0.3), 0.0, std::sqrt(0.7), 0.0, 0.0, 0.0;
  const Eigen::Vector2d f_x(1.0, 1.1), f_n(1.0, 1.2);
  const std::vector<ModePair> kept = pair_by_mac(f_x, phi_x, f_n, phi_n, {.minimum_mac = 0.5});
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].experimental, 0);
  EXPECT_EQ(kept[0].numerical, 0);
  EXPECT_EQ(pair_by_mac(f_x, phi_x, f_n, phi_n)[0].numerical, 1);
}

// Oracle: hand calculation. Two close computed modes rotated by 45 degrees: each measured shape has MAC 1/2 with either, and
// lies wholly in their span. Modes that are not close are not a cluster, whatever their span.
TEST(PairByMac, RecognisesARotatedPair) {
  const double c = std::sqrt(0.5);
  const Eigen::MatrixXcd phi_n = shapes(3);
  Eigen::MatrixXcd phi_x(6, 2);
  phi_x << c * (phi_n.col(0) + phi_n.col(1)), c * (phi_n.col(0) - phi_n.col(1));
  const std::vector<ModePair> close = pair_by_mac(Eigen::Vector2d(1.0, 1.01), phi_x, Eigen::Vector3d(1.0, 1.005, 1.3), phi_n);
  ASSERT_EQ(close.size(), 2U);
  for (const ModePair& pair : close) {
    EXPECT_TRUE(pair.clustered);
    EXPECT_NEAR(pair.mac, 1.0, 1e-12);
    EXPECT_LT(pair.numerical, 2);
  }
  EXPECT_NE(close[0].numerical, close[1].numerical);
  const std::vector<ModePair> apart = pair_by_mac(Eigen::Vector2d(1.0, 1.01), phi_x, Eigen::Vector3d(1.0, 1.1, 1.3), phi_n);
  for (const ModePair& pair : apart) {
    EXPECT_FALSE(pair.clustered);
    EXPECT_NEAR(pair.mac, 0.5, 1e-12);
  }
}

// Oracle: by construction. Close modes whose shapes are not orthogonal at the sensors, each measured nearly as computed: 1X is
// mostly 2N and 2X mostly 1N. The share of either in the span is larger than its MAC with its own mode; that must not count
// for the other one (it once did, and exact data were paired the wrong way round).
TEST(PairByMac, GivesCloseModesTheirOwnShapes) {
  const Eigen::MatrixXcd basis = shapes(2);
  Eigen::MatrixXcd phi_n(6, 2), phi_x(6, 2);
  phi_n << basis.col(0), 0.3 * basis.col(0) + basis.col(1);
  phi_x << 0.15 * phi_n.col(0) + phi_n.col(1), phi_n.col(0) - 0.2 * phi_n.col(1);
  const Eigen::Vector2d f_n(1.0, 1.01);
  const std::vector<ModePair> pairs = pair_by_mac(Eigen::Vector2d(0.98, 1.005), phi_x, f_n, phi_n);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].numerical, 1);
  EXPECT_EQ(pairs[1].numerical, 0);
  const auto own_mac = [&](Eigen::Index i, Eigen::Index j) {
    return std::norm(phi_n.col(j).dot(phi_x.col(i))) / (phi_n.col(j).squaredNorm() * phi_x.col(i).squaredNorm());
  };
  for (const ModePair& pair : pairs) {
    EXPECT_FALSE(pair.clustered);
    EXPECT_GT(pair.mac, 0.9);
    EXPECT_NEAR(pair.mac, own_mac(pair.experimental, pair.numerical), 1e-12);
  }
  // A second estimate of one and the same mode is not the other mode of the run.
  phi_x.col(1) = phi_x.col(0);
  EXPECT_EQ(pair_by_mac(Eigen::Vector2d(0.98, 1.005), phi_x, f_n, phi_n, {.minimum_mac = 0.3}).size(), 1U);
}

// Oracle: hand calculation. Modes turned by 30 degrees: MAC 0.75 with the own mode and 0.25 with the other, subspace MAC 1.
TEST(PairByMac, PutsTheNearerShapeFirstWithinASpan) {
  const Eigen::MatrixXcd phi_n = shapes(2);
  const double c = std::sqrt(0.75), s = 0.5;
  Eigen::MatrixXcd phi_x(6, 2);
  phi_x << c * phi_n.col(1) - s * phi_n.col(0), c * phi_n.col(0) + s * phi_n.col(1);
  const std::vector<ModePair> pairs = pair_by_mac(Eigen::Vector2d(1.0, 1.01), phi_x, Eigen::Vector2d(1.0, 1.005), phi_n);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].numerical, 1);
  EXPECT_EQ(pairs[1].numerical, 0);
  for (const ModePair& pair : pairs) {
    EXPECT_TRUE(pair.clustered);
    EXPECT_NEAR(pair.mac, 1.0, 1e-12);
  }
}

// Oracle: by construction. Without sensors the nearest frequencies belong together and no MAC is claimed.
TEST(PairByMac, GoesByFrequencyWithoutShapes) {
  const std::vector<ModePair> pairs =
      pair_by_mac(Eigen::Vector2d(1.0, 2.0), Eigen::MatrixXcd(0, 2), Eigen::Vector3d(0.8, 1.02, 1.97), Eigen::MatrixXcd(0, 3));
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].numerical, 1);
  EXPECT_EQ(pairs[1].numerical, 2);
  EXPECT_TRUE(std::isnan(pairs[0].mac));
}

// Oracle: the definition. One component has a MAC of 1 with every other: modes measured at one channel are paired by frequency,
// and no MAC is claimed; the third, measured at two, by its shape.
TEST(PairByMac, TakesOneComponentForNoShape) {
  const double none = std::nan("");
  Eigen::MatrixXcd phi_n(2, 3), phi_x(2, 3);
  phi_n << 1, 2, 3, 1, -1, 5;
  phi_x << 1, 1, 4, none, none, -2;
  const Eigen::Vector3d f_n(12.0, 13.2, 15.4), f_x(12.6, 14.7, 13.0);
  const std::vector<ModePair> pairs = pair_by_mac(f_x, phi_x, f_n, phi_n);
  ASSERT_EQ(pairs.size(), 3U);
  const std::vector<Eigen::Index> partner = {0, 2, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pairs[i].numerical, partner[i]) << i;
    EXPECT_EQ(std::isnan(pairs[i].mac), i < 2) << i;
  }
}

// Oracle: by construction. Two computed modes have one shape at the sensors: the nearer frequencies belong together, whatever
// rounding makes of the MACs.
TEST(PairByMac, LeavesTiesToTheFrequency) {
  Eigen::MatrixXcd phi_n(3, 2), phi_x(3, 2);
  phi_n << 0.1, 0.3, 0.2, 0.6, 0.7, 2.1;
  phi_x << 0.3, 0.1, 0.6, 0.2, 2.1, 0.7;
  for (const bool exchanged : {false, true}) {
    const Eigen::Vector2d f_x = exchanged ? Eigen::Vector2d(1.19, 1.01) : Eigen::Vector2d(1.01, 1.19);
    const std::vector<ModePair> pairs = pair_by_mac(f_x, phi_x, Eigen::Vector2d(1.0, 1.2), phi_n);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].numerical, exchanged ? 1 : 0);
  }
}

// Oracle: by construction. More references than new modes: the one without likeness is left without a partner.
TEST(FollowModes, LeavesTheUnlikeOne) {
  Eigen::MatrixXd likeness(3, 2);
  likeness << 0.1, 0.9, 0.0, 0.05, 0.8, 0.3;
  EXPECT_EQ(twindeck::matching::follow_modes(likeness), (std::vector<int>{1, -1, 0}));
}

}  // namespace
