// Oracles: the point of a straight valley nearest to the initial values, worked by hand; of a bent valley by a scan with dense
// eigenvalues (Eigen).
#include "updating/valley_walk.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "chain.hpp"

namespace twindeck::updating {
namespace {

UpdatingResult updated(const fe::ParametricSystem& system, const Eigen::VectorXd& measured_Hz, std::uint64_t seed,
                       double std_Hz) {
  std::vector<FrequencyTarget> targets;
  for (Eigen::Index i = 0; i < measured_Hz.size(); ++i)
    targets.push_back({std::to_string(i + 1), static_cast<int>(i), measured_Hz(i)});
  std::vector<int> active;
  for (int j = 0; j < std::ssize(system.parameters); ++j) active.push_back(j);
  UpdatingOptions options;
  options.seed = seed;
  MeasuredRows rows;
  if (std_Hz > 0.0) rows.covariance = std_Hz * std_Hz * Eigen::MatrixXd::Identity(measured_Hz.size(), measured_Hz.size());
  return update(system, {}, active, targets, options, {}, rows);
}

// Frequencies depend on a/m and b/m alone: any multiple t of the truth (0.5, 1.1, 0.8) is exact. In units of the ranges (5, 5,
// 2) the nearest to (1, 1, 1) has t (0.5²/25 + 1.1²/25 + 0.8²/4) = (0.5 + 1.1)/25 + 0.8/4.
TEST(ValleyWalk, EndsAtTheNearestPointOfAStraightValley) {
  SmallSystem small(2);
  const int a = small.parameter("a", 1.0, 0.1, 5.1), b = small.parameter("b", 1.0, 0.1, 5.1),
            m = small.parameter("m", 1.0, 0.3, 2.3);
  small.stiffness(100.0 * spring(2, 0, -1), a).stiffness(80.0 * spring(2, 1, 0), b);
  small.mass(Eigen::MatrixXd::Identity(2, 2), m);
  const Eigen::Vector3d truth(0.5, 1.1, 0.8);
  const double t = (1.6 / 25.0 + 0.8 / 4.0) / (0.25 / 25.0 + 1.21 / 25.0 + 0.64 / 4.0);
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const double std_Hz : {0.0, 0.01}) {
      const UpdatingResult result = updated(small.system(), dense_frequencies(small.system(), truth), seed, std_Hz);
      ASSERT_TRUE(result.status.converged) << result.status.message;
      EXPECT_LT((result.theta - t * truth).norm(), 1e-4) << seed << ": " << result.theta.transpose();
      EXPECT_EQ(result.flat.cols(), 1);
      const StartResult& best = result.starts[static_cast<std::size_t>(result.best)];
      EXPECT_EQ(best.theta, result.theta);
      EXPECT_LT(best.cost, std_Hz > 0.0 ? 1e-6 : 1e-10);
      EXPECT_EQ(best.optimum, result.optima.front());
    }
  }
}

// One frequency of two masses and two springs: the valley f1(a, b) = f1(2.2, 0.6) bends. Its nearest point to (1, 1) by a scan
// over a with b from a bisection.
TEST(ValleyWalk, EndsAtTheNearestPointOfABentValley) {
  SmallSystem small(2);
  const int a = small.parameter("a", 1.0, 0.2, 4.2), b = small.parameter("b", 1.0, 0.2, 4.2);
  small.stiffness(100.0 * spring(2, 0, -1), a).stiffness(100.0 * spring(2, 1, 0), b).mass(Eigen::MatrixXd::Identity(2, 2));
  const Eigen::VectorXd measured = dense_frequencies(small.system(), Eigen::Vector2d(2.2, 0.6)).head(1);
  const auto partner = [&](double of) {
    double low = 0.2, high = 4.2;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      (dense_frequencies(small.system(), Eigen::Vector2d(of, middle))(0) < measured(0) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  Eigen::Vector2d nearest = Eigen::Vector2d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (double of = 0.8; of < 3.0; of += 1e-3) {
    const Eigen::Vector2d point(of, partner(of));
    const double way = (point - Eigen::Vector2d::Ones()).norm();
    if (point(1) > 4.19 || way >= least) continue;
    least = way;
    nearest = point;
  }
  for (const std::uint64_t seed : {1, 2, 3}) {
    const UpdatingResult result = updated(small.system(), measured, seed, 0.0);
    ASSERT_TRUE(result.status.converged) << result.status.message;
    EXPECT_LT((result.theta - nearest).norm(), 2e-3) << seed << ": " << result.theta.transpose();
  }
}

// Two masses between walls, symmetric: at equal ends the frequencies feel their difference in the second order alone. It is
// determined all the same: there is one way only to be as stiff as measured.
TEST(ValleyWalk, AnOptimumThatIsFlatInTheFirstOrderOnlyIsNoValley) {
  SmallSystem small(2);
  const int left = small.parameter("left", 1.0, 0.5, 1.5), right = small.parameter("right", 1.0, 0.5, 1.5);
  small.stiffness(400.0 * spring(2, 0, -1), left).stiffness(400.0 * spring(2, 1, -1), right);
  small.stiffness(100.0 * spring(2, 0, 1)).mass(Eigen::MatrixXd::Identity(2, 2));
  const UpdatingResult result = updated(small.system(), dense_frequencies(small.system(), Eigen::Vector2d(0.8, 0.8)), 1, 0.0);
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_EQ(result.flat.cols(), 0);
  EXPECT_LT((result.theta - Eigen::Vector2d(0.8, 0.8)).norm(), 1e-3);
}

}  // namespace
}  // namespace twindeck::updating
