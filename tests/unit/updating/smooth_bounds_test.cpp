// The smooth map beside the bounded search. Oracles: the closed-form optimum of Rosenbrock's function on a bound; the bounded
// search, whose optimum is the enumerated one (problem_test.cpp), on correlated columns with several active bounds.
#include <gtest/gtest.h>

#include <random>

#include "updating/problem.hpp"

namespace twindeck::updating {
namespace {

TEST(SmoothBounds, FindsRosenbrockOnABound) {
  const auto rosenbrock = [](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    residual << 10.0 * (x(1) - x(0) * x(0)), 1.0 - x(0);
    if (jacobian != nullptr) {
      jacobian->resize(2, 2);
      *jacobian << -20.0 * x(0), 10.0, -1.0, 0.0;
    }
    return true;
  };
  const Box box{Eigen::Vector2d(-3.0, -3.0), Eigen::Vector2d(0.5, 3.0)};
  BoundedOptions options;
  options.max_iterations = 400;
  const BoundedResult result = minimise_by_smooth_map(rosenbrock, 2, Eigen::Vector2d(-1.2, 1.0), box, options);
  EXPECT_NEAR(result.x(0), 0.5, 1e-4);
  EXPECT_NEAR(result.x(1), 0.25, 1e-3);
  EXPECT_NEAR(result.cost, 0.125, 1e-6);
  EXPECT_LE(result.x(0), 0.5);  // never outside
}

TEST(SmoothBounds, AgreesWithTheBoundedSearchWhereSeveralBoundsAreActive) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  int with_bounds = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::MatrixXd a(8, 4);
    Eigen::VectorXd b(8);
    for (double& v : a.reshaped()) v = normal(random);
    for (double& v : b) v = 2.0 * normal(random);
    a.col(1) = 0.9 * a.col(0) + 0.1 * a.col(1);  // as stiffnesses that do nearly the same
    const auto linear = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
      residual = a * x - b;
      if (jacobian != nullptr) *jacobian = a;
      return true;
    };
    const Box box{Eigen::VectorXd::Constant(4, -0.5), Eigen::VectorXd::Constant(4, 0.5)};
    BoundedOptions options;
    options.max_iterations = 1000;
    const BoundedResult bounded = minimise_on_box(linear, 8, Eigen::VectorXd::Zero(4), box, options, {});
    const BoundedResult smooth = minimise_by_smooth_map(linear, 8, Eigen::VectorXd::Zero(4), box, options);
    ASSERT_TRUE(bounded.converged);
    const auto side = on_bound(bounded.x, box, 1e-6);
    with_bounds += std::count(side.begin(), side.end(), 0) <= 2;
    EXPECT_LE(bounded.cost, smooth.cost * (1.0 + 1e-9)) << trial;  // the enumerated optimum is the least there is
    EXPECT_NEAR(smooth.cost / bounded.cost, 1.0, 1e-4) << trial;
    EXPECT_LT((smooth.x - bounded.x).cwiseAbs().maxCoeff(), 0.02) << trial;
  }
  EXPECT_GE(with_bounds, 8);  // or the agreement would say nothing of bounds
}

}  // namespace
}  // namespace twindeck::updating
