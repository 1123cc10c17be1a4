// Forces of coupled friction units. Oracles: hand calculations of one unit; the law itself, which has one solution, checked on
// random units; symmetry in the sign.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "transient/newmark.hpp"

namespace twindeck::transient {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd single(double value) { return VectorXd::Constant(1, value); }

/// Largest error of F = clip(k (x_free - G F - x_p), ±F_c). [N]
double error_of_law(const VectorXd& free, const MatrixXd& g, const VectorXd& k, const VectorXd& threshold,
                    const VectorXd& plastic, const VectorXd& force) {
  const VectorXd trial = k.cwiseProduct(free - g * force - plastic);
  return (trial.cwiseMin(threshold).cwiseMax(-threshold) - force).cwiseAbs().maxCoeff();
}

// Stuck: F = k x / (1 + k G). k = 2000 N/m, G = 1e-3 m/N, x = 3 mm beyond the point of rest: F = 6 / 3.
TEST(FrictionBalance, OfAStuckUnitIsASpringInSeries) {
  VectorXd force = single(0.0);
  ASSERT_TRUE(
      balance_friction(single(0.013), MatrixXd::Constant(1, 1, 1e-3), single(2000.0), single(50.0), single(0.010), force));
  EXPECT_NEAR(force(0), 2.0, 1e-12);
}

// Sliding: 2000 · 0.2 / 3 = 133 N is above the threshold, which it then carries, with the sign of the movement.
TEST(FrictionBalance, OfASlidingUnitIsItsThreshold) {
  for (const double side : {-1.0, 1.0}) {
    VectorXd force = single(0.0);
    ASSERT_TRUE(
        balance_friction(single(side * 0.2), MatrixXd::Constant(1, 1, 1e-3), single(2000.0), single(50.0), single(0.0), force));
    EXPECT_DOUBLE_EQ(force(0), side * 50.0);
  }
}

// Limits: no threshold carries nothing, no stiffness neither.
TEST(FrictionBalance, OfAUnitWithoutThresholdOrStiffnessIsZero) {
  VectorXd force = single(7.0);
  ASSERT_TRUE(balance_friction(single(0.2), MatrixXd::Constant(1, 1, 1e-3), single(2000.0), single(0.0), single(0.0), force));
  EXPECT_EQ(force(0), 0.0);
  force = single(7.0);
  ASSERT_TRUE(balance_friction(single(0.2), MatrixXd::Constant(1, 1, 1e-3), single(0.0), single(50.0), single(0.0), force));
  EXPECT_EQ(force(0), 0.0);
}

// Two units on one point, one of which slides: (1 + k2 G) F2 = k2 (x - G F1), F1 = 10. With k = 1000 N/m each, G = 1e-3 m/N,
// x = 0.05 m: F2 = (50 - 10) / 2 = 20.
TEST(FrictionBalance, OfTwoUnitsOnOnePointSharesTheMovement) {
  VectorXd force = VectorXd::Zero(2);
  ASSERT_TRUE(balance_friction(VectorXd::Constant(2, 0.05), MatrixXd::Constant(2, 2, 1e-3), VectorXd::Constant(2, 1000.0),
                               Eigen::Vector2d(10.0, 100.0), VectorXd::Zero(2), force));
  EXPECT_LT((force - Eigen::Vector2d(10.0, 20.0)).norm(), 1e-10);
}

struct Units {
  MatrixXd flexibility;
  VectorXd free, stiffness, threshold, plastic;
};

/// Random units on a random structure; `reach` is the largest product of stiffness and flexibility.
Units random_units(std::mt19937_64& random, double reach) {
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const auto draw = [&](double) { return even(random); };
  Units units;
  const MatrixXd root = MatrixXd::Zero(4, 4).unaryExpr(draw);
  units.flexibility = root * root.transpose();
  units.stiffness = VectorXd::Zero(4).unaryExpr([&](double) { return 1.0 + 0.5 * even(random); });
  units.stiffness *= reach / units.stiffness.cwiseProduct(units.flexibility.diagonal()).maxCoeff();
  units.free = VectorXd::Zero(4).unaryExpr(draw);
  units.plastic = 0.3 * VectorXd::Zero(4).unaryExpr(draw);
  units.threshold = VectorXd::Zero(4).unaryExpr([&](double) { return 0.3 * std::min(reach, 1.0) * (1.0 + even(random)); });
  return units;
}

// The law is that of a strictly convex problem, so it has one solution, whatever the guess. Rounding is 1e-12 of forces of 1 N.
TEST(FrictionBalance, ObeysTheLawFromAnyGuess) {
  std::mt19937_64 random(7);
  int mixed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Units u = random_units(random, 0.5);
    VectorXd force = VectorXd::Zero(4), other = u.threshold, mirrored = VectorXd::Zero(4);
    ASSERT_TRUE(balance_friction(u.free, u.flexibility, u.stiffness, u.threshold, u.plastic, force)) << trial;
    EXPECT_LT(error_of_law(u.free, u.flexibility, u.stiffness, u.threshold, u.plastic, force), 1e-10) << trial;
    ASSERT_TRUE(balance_friction(u.free, u.flexibility, u.stiffness, u.threshold, u.plastic, other)) << trial;
    EXPECT_LT((force - other).norm(), 1e-10) << trial;
    ASSERT_TRUE(balance_friction(-u.free, u.flexibility, u.stiffness, u.threshold, -u.plastic, mirrored)) << trial;
    EXPECT_LT((force + mirrored).norm(), 1e-10) << trial;
    const auto sliding = ((force.cwiseAbs() - u.threshold).array().abs() < 1e-12).count();
    mixed += sliding > 0 && sliding < 4;
  }
  EXPECT_GT(mixed, 50);  // or the law would be tried on its easy cases alone
}

// A spring that is stiff beside the flexibility, k G = 20, at three times its threshold before it gives: F = 1000 / 21 N.
TEST(FrictionBalance, OfAStiffUnitIsFound) {
  VectorXd force = single(0.0);
  ASSERT_TRUE(balance_friction(single(1e-3), MatrixXd::Constant(1, 1, 2e-5), single(1e6), single(100.0), single(0.0), force));
  EXPECT_NEAR(force(0), 1000.0 / 21.0, 1e-9);
}

// The same law as above with k G up to a million. Forces are below 1 N; rounding grows with k G.
TEST(FrictionBalance, OfStiffUnitsObeysTheLaw) {
  std::mt19937_64 random(8);
  for (const double reach : {2.0, 10.0, 1e3, 1e6}) {
    for (int trial = 0; trial < 100; ++trial) {
      const Units u = random_units(random, reach);
      VectorXd force = VectorXd::Zero(4);
      ASSERT_TRUE(balance_friction(u.free, u.flexibility, u.stiffness, u.threshold, u.plastic, force)) << reach << " " << trial;
      EXPECT_LT(error_of_law(u.free, u.flexibility, u.stiffness, u.threshold, u.plastic, force), 1e-10 * reach) << trial;
    }
  }
}

}  // namespace
}  // namespace twindeck::transient
