#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <cstdlib>

#include "matching/pairing.hpp"
#include "modal/mac.hpp"
#include "pair_by_mac.hpp"

/// Properties of MAC and pairing over random complex shapes.
namespace {

using twindeck::pair_by_mac;
using twindeck::matching::ModePair;
using twindeck::modal::mac;

struct Shapes {
  Eigen::MatrixXcd n, x;
};

Shapes random_shapes(unsigned seed, int sensors, int n_n, int n_x) {
  std::srand(seed);
  return {Eigen::MatrixXcd::Random(sensors, n_n), Eigen::MatrixXcd::Random(sensors, n_x)};
}

// Law: entries lie in [0, 1], a set against itself has ones on the diagonal, and exchange of the sets transposes.
TEST(MacLaw, IsASquaredCosine) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Shapes s = random_shapes(seed, 2 + static_cast<int>(seed % 5), 6, 4);
    const Eigen::MatrixXd m = mac(s.n, s.x);
    EXPECT_GE(m.minCoeff(), 0.0);
    EXPECT_LE(m.maxCoeff(), 1.0);
    EXPECT_LT((mac(s.n, s.n).diagonal().array() - 1.0).abs().maxCoeff(), 1e-14);
    EXPECT_LT((mac(s.x, s.n).transpose() - m).norm(), 1e-13);
  }
}

// Law: a shape has no scale, sign or phase.
TEST(MacLaw, DoesNotChangeWithScaleOrPhase) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Shapes s = random_shapes(seed, 7, 5, 4);
    const Eigen::VectorXcd factor = 1e3 * Eigen::VectorXcd::Random(4);
    EXPECT_LT((mac(s.n, s.x * factor.asDiagonal()) - mac(s.n, s.x)).cwiseAbs().maxCoeff(), 1e-12);
  }
}

// Law: no mode has two partners.
TEST(PairingLaw, IsOneToOne) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const Shapes s = random_shapes(seed, 9, 8, 6);
    const Eigen::VectorXd f_n = (Eigen::VectorXd::Random(8).array() + 2.0), f_x = (Eigen::VectorXd::Random(6).array() + 2.0);
    const std::vector<ModePair> pairs = pair_by_mac(f_x, s.x, f_n, s.n);
    std::vector<Eigen::Index> x, n;
    for (const ModePair& pair : pairs) {
      x.push_back(pair.experimental);
      n.push_back(pair.numerical);
      EXPECT_LE(std::abs(f_n[pair.numerical] / f_x[pair.experimental] - 1.0), 0.35);
    }
    std::sort(n.begin(), n.end());
    EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
    EXPECT_EQ(std::adjacent_find(x.begin(), x.end()), x.end());
    EXPECT_EQ(std::adjacent_find(n.begin(), n.end()), n.end());
  }
}

// Law: renumbering the numerical modes renumbers the pairs and nothing else.
TEST(PairingLaw, FollowsARenumbering) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Shapes s = random_shapes(seed, 9, 6, 5);
    const Eigen::VectorXd f_n = Eigen::VectorXd::LinSpaced(6, 1.0, 1.3), f_x = Eigen::VectorXd::LinSpaced(5, 1.0, 1.3);
    const std::vector<ModePair> pairs = pair_by_mac(f_x, s.x, f_n, s.n);
    const std::vector<ModePair> turned = pair_by_mac(f_x, s.x, f_n.reverse(), s.n.rowwise().reverse());
    ASSERT_EQ(pairs.size(), turned.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(pairs[i].experimental, turned[i].experimental);
      EXPECT_EQ(pairs[i].numerical, 5 - turned[i].numerical);
      EXPECT_NEAR(pairs[i].mac, turned[i].mac, 1e-12);
    }
  }
}

}  // namespace
