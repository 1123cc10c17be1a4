// Updating of spring-mass chains. Oracles: parameters that the targets were computed from (dense eigenvalues, Eigen); a
// brute-force grid where the optimum lies on bounds; the mirror image of a symmetric chain as second optimum.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "chain.hpp"
#include "core/parallel.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {
namespace {

std::vector<FrequencyTarget> targets_of(const Eigen::VectorXd& frequency_Hz, const std::vector<int>& reference_mode) {
  std::vector<FrequencyTarget> targets;
  for (std::size_t i = 0; i < reference_mode.size(); ++i) {
    targets.push_back({std::to_string(i + 1), reference_mode[i], frequency_Hz(static_cast<Eigen::Index>(i))});
  }
  return targets;
}

UpdatingOptions starts(int n) {
  UpdatingOptions options;
  options.starts = n;
  return options;
}

// Five masses between walls; three parameters: two groups of springs and a factor on the masses' variable part.
SmallSystem chain(double lower, double upper) {
  SmallSystem small(5);
  const int k1 = small.parameter("k1", 1.0, lower, upper), k2 = small.parameter("k2", 1.0, lower, upper),
            m = small.parameter("m", 1.0, lower, upper);
  for (int i = 0; i < 6; ++i) small.stiffness(400.0 * spring(5, i < 5 ? i : -1, i - 1), i < 2 ? k1 : k2);
  Eigen::VectorXd own(5), variable(5);
  own << 1.0, 1.2, 0.8, 1.1, 1.3;
  variable << 0.0, 0.5, 0.0, 0.0, 0.9;
  return small.mass(own.asDiagonal().toDenseMatrix()).mass(variable.asDiagonal().toDenseMatrix(), m);
}

TEST(Update, RecoversParametersInsideTheBounds) {
  const SmallSystem small = chain(0.5, 1.6);
  const Eigen::Vector3d truth(1.23, 0.87, 1.31);
  const UpdatingResult result = update(small.system(), {}, {0, 1, 2},
                                       targets_of(dense_frequencies(small.system(), truth), {0, 1, 2, 3, 4}), starts(4), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_NEAR((result.theta - truth).cwiseAbs().maxCoeff(), 0.0, 1e-7);
  EXPECT_EQ(result.on_bound, (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(result.optima.size(), 1U);
  EXPECT_NEAR((result.frequency_before_Hz - dense_frequencies(small.system(), Eigen::Vector3d::Ones())).norm(), 0.0, 1e-9);
}

TEST(Update, MeetsTheGridOptimumOnSeveralBounds) {
  const SmallSystem small = chain(0.9, 1.1);
  const Eigen::VectorXd measured = dense_frequencies(small.system(), Eigen::Vector3d(1.4, 0.7, 1.6));
  const UpdatingResult result = update(small.system(), {}, {0, 1, 2}, targets_of(measured, {0, 1, 2, 3, 4}), starts(6), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  constexpr int grid = 40;
  double best = std::numeric_limits<double>::infinity();
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= grid; ++j)
      for (int k = 0; k <= grid; ++k) {
        const Eigen::Vector3d theta = Eigen::Vector3d::Constant(0.9) + 0.2 / grid * Eigen::Vector3d(i, j, k);
        const Eigen::VectorXd residual = (dense_frequencies(small.system(), theta).array() / measured.array() - 1.0).matrix();
        if (0.5 * residual.squaredNorm() < best) best = 0.5 * residual.squaredNorm(), at = theta;
      }
  const double cost = result.starts[static_cast<std::size_t>(result.best)].cost;
  EXPECT_LE(cost, best * (1.0 + 1e-9));                                     // at least as good as every grid point
  EXPECT_NEAR((result.theta - at).cwiseAbs().maxCoeff(), 0.0, 0.2 / grid);  // and in the cell of the best
  EXPECT_GE(std::count_if(result.on_bound.begin(), result.on_bound.end(), [](int s) { return s != 0; }), 2);
  for (const StartResult& start : result.starts) EXPECT_TRUE(start.converged) << start.message;
}

// Two oscillators, weakly coupled. The measurement has them in the other order: followed by shape, each keeps its own target.
TEST(Update, FollowsModesThatChangeOrder) {
  SmallSystem small(2);
  const int a = small.parameter("a", 1.0, 0.3, 3.0), b = small.parameter("b", 1.5, 0.3, 3.0);
  small.stiffness(100.0 * spring(2, 0, -1), a).stiffness(100.0 * spring(2, 1, -1), b).stiffness(0.5 * spring(2, 0, 1));
  small.mass(Eigen::MatrixXd::Identity(2, 2));
  const Eigen::VectorXd ordered = dense_frequencies(small.system(), Eigen::Vector2d(2.0, 1.1));
  const UpdatingResult result = update(small.system(), {}, {a, b}, targets_of(ordered.reverse(), {0, 1}), starts(1), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_NEAR((result.theta - Eigen::Vector2d(2.0, 1.1)).norm(), 0.0, 1e-6);
  EXPECT_EQ(result.mode_after, (std::vector<int>{1, 0}));
  EXPECT_GT(result.followed_mac.minCoeff(), 0.95);
}

// A parameter that no compared frequency feels stays at its start, and its starts are one optimum.
TEST(Update, AFlatParameterDoesNotBreakIt) {
  SmallSystem small(3);
  const int k = small.parameter("k", 1.0, 0.5, 2.0), flat = small.parameter("flat", 1.0, 0.5, 2.0);
  small.stiffness(100.0 * (spring(3, 0, -1) + spring(3, 0, 1)), k).stiffness(9e3 * spring(3, 2, -1), flat);
  small.mass(Eigen::MatrixXd::Identity(3, 3));
  const Eigen::VectorXd measured = dense_frequencies(small.system(), Eigen::Vector2d(1.3, 1.0)).head(2);
  const UpdatingResult result = update(small.system(), {}, {k, flat}, targets_of(measured, {0, 1}), starts(5), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_NEAR(result.theta(k), 1.3, 1e-7);
  EXPECT_EQ(result.optima.size(), 1U);
  for (const StartResult& start : result.starts) {
    EXPECT_TRUE(start.converged) << start.message;
    EXPECT_NEAR(start.theta(1), start.initial(1), 1e-9);
  }
}

// Mirror images have equal frequencies: outer springs (0.8, 1.4) and (1.4, 0.8) are both exact.
TEST(Update, FindsBothOptimaOfASymmetricChain) {
  SmallSystem small(3);
  const int left = small.parameter("left", 1.0, 0.5, 2.0), right = small.parameter("right", 1.05, 0.5, 2.0);
  small.stiffness(100.0 * spring(3, 0, -1), left).stiffness(100.0 * spring(3, 2, -1), right);
  small.stiffness(300.0 * (spring(3, 0, 1) + spring(3, 1, 2))).mass(Eigen::MatrixXd::Identity(3, 3));
  const UpdatingResult result =
      update(small.system(), {}, {left, right},
             targets_of(dense_frequencies(small.system(), Eigen::Vector2d(0.8, 1.4)), {0, 1, 2}), starts(8), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  ASSERT_EQ(result.optima.size(), 2U);
  std::vector<double> lefts;
  for (const int k : result.optima) lefts.push_back(result.starts[static_cast<std::size_t>(k)].theta(0));
  std::sort(lefts.begin(), lefts.end());
  EXPECT_NEAR(lefts[0], 0.8, 1e-6);
  EXPECT_NEAR(lefts[1], 1.4, 1e-6);
}

// A frozen term that follows the parameter only between solves, as prestress does: the fixed point must be self-consistent.
TEST(Update, RefreshesTheFrozenPartUntilParametersRest) {
  const auto assembled = [](double frozen) {
    SmallSystem small(2);
    const int k = small.parameter("k", 1.0, 0.2, 3.0);
    small.stiffness(100.0 * spring(2, 0, -1) + 80.0 * spring(2, 1, 0), k).stiffness(30.0 * frozen * spring(2, 1, -1));
    small.mass(Eigen::MatrixXd::Identity(2, 2));
    return small.system();
  };
  const Refresh refresh = [&](const Eigen::VectorXd& theta) { return assembled(theta(0)); };
  const Eigen::VectorXd measured = dense_frequencies(assembled(1.5), Eigen::VectorXd::Constant(1, 1.5));
  UpdatingOptions options = starts(2);
  options.outer_iterations = 40;
  const UpdatingResult result = update(assembled(1.0), refresh, {0}, targets_of(measured, {0, 1}), options, {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_NEAR(result.theta(0), 1.5, 1e-5);
  EXPECT_GT(result.starts[0].outer, 2);

  options.outer_iterations = 2;  // too few: must be said, not hidden
  const UpdatingResult early = update(assembled(1.0), refresh, {0}, targets_of(measured, {0, 1}), options, {});
  EXPECT_FALSE(early.status.converged);
  EXPECT_NE(early.status.message.find("prestress"), std::string::npos) << early.status.message;
}

TEST(Update, CostNeverRisesWithinASolveAndThreadsDoNotMatter) {
  const SmallSystem small = chain(0.9, 1.1);
  const auto targets = targets_of(dense_frequencies(small.system(), Eigen::Vector3d(1.4, 0.7, 1.6)), {0, 1, 2, 3, 4});
  const int threads = thread_count();
  set_thread_count(1);
  const UpdatingResult one = update(small.system(), {}, {0, 1, 2}, targets, starts(6), {});
  set_thread_count(3);
  const UpdatingResult three = update(small.system(), {}, {0, 1, 2}, targets, starts(6), {});
  set_thread_count(threads);
  std::map<std::pair<int, int>, double> last;
  for (const IterationRecord& record : one.history) {
    const auto [at, first] = last.try_emplace({record.start, record.outer}, record.cost);
    if (!first) {
      EXPECT_LE(record.cost, at->second);
    }
    at->second = record.cost;
  }
  EXPECT_EQ(last.size(), 6U);
  ASSERT_EQ(one.history.size(), three.history.size());
  for (std::size_t i = 0; i < one.history.size(); ++i) EXPECT_EQ(one.history[i].theta, three.history[i].theta);
  EXPECT_EQ(one.theta, three.theta);
}

TEST(Update, RefusesWhatCannotBeUpdated) {
  SmallSystem small(1);
  small.stiffness(Eigen::MatrixXd::Ones(1, 1), small.parameter("fixed", 1.0, 1.0, 1.0)).mass(Eigen::MatrixXd::Ones(1, 1));
  const auto message = [&](const std::vector<int>& active, const std::vector<FrequencyTarget>& targets) -> std::string {
    try {
      (void)update(small.system(), {}, active, targets, starts(1), {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({0}, {{"1X-1N", 0, 0.2}}).find("fixed"), std::string::npos);
  EXPECT_NE(message({}, {{"1X-1N", 0, 0.2}}).find("no parameter"), std::string::npos);
  EXPECT_NE(message({0}, {}).find("no frequency"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::updating
