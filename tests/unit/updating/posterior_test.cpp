// Covariance of updated parameters. Oracles: the closed form of one and of two parameters; invariances (units, order of
// parameters, whitened rows turned by an orthogonal matrix); limits of strong and of no data.
#include "updating/posterior.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace twindeck::updating {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Box box_about_zero(int n, double half) { return {VectorXd::Constant(n, -half), VectorXd::Constant(n, half)}; }

/// A point inside the box at which the gradient vanishes.
Linearised optimum(const MatrixXd& jacobian) {
  Linearised at;
  at.jacobian = jacobian;
  at.residual = VectorXd::Zero(jacobian.rows());
  return at;
}

MatrixXd three_by_two() { return (MatrixXd(3, 2) << 3.0, 1.0, -1.0, 2.0, 0.5, 0.25).finished(); }

// One parameter seen by one row with slope s and a uniform prior of range w: 1/std² = s² + 12/w².
TEST(PosteriorOfOneParameter, AddsPrecisionsOfRowAndPrior) {
  const double slope = 3.0, range = 2.0, unit = 7.0;
  const Posterior known = posterior(optimum(MatrixXd::Constant(1, 1, slope)), VectorXd::Zero(1), box_about_zero(1, 1.0),
                                    VectorXd::Constant(1, unit));
  EXPECT_NEAR(known.prior_std(0), unit * range / std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(known.std(0), unit / std::sqrt(slope * slope + 12.0 / (range * range)), 1e-12);
  EXPECT_DOUBLE_EQ(known.correlation(0, 0), 1.0);
}

// Limits: without a row's say the prior stays, and with a strong one the row alone counts.
TEST(PosteriorOfOneParameter, MeetsItsLimits) {
  const auto std_at = [](double slope) {
    return posterior(optimum(MatrixXd::Constant(1, 1, slope)), VectorXd::Zero(1), box_about_zero(1, 1.0), VectorXd::Ones(1));
  };
  const Posterior blind = std_at(0.0);
  EXPECT_NEAR(blind.std(0), blind.prior_std(0), 1e-14);
  ASSERT_EQ(blind.flat.size(), 1U);
  EXPECT_NEAR(blind.flat[0].step(0), blind.prior_std(0), 1e-14);
  EXPECT_NEAR(std_at(1e6).std(0) * 1e6, 1.0, 1e-9);
}

// A direction is flat while the rows lower its variance by less than half: slope · prior deviation below 1.
TEST(PosteriorOfOneParameter, IsFlatUntilTheRowsHalveItsVariance) {
  const double prior = 2.0 / std::sqrt(12.0);
  for (const double seen : {0.99, 1.01}) {
    const Posterior known = posterior(optimum(MatrixXd::Constant(1, 1, seen / prior)), VectorXd::Zero(1),
                                      box_about_zero(1, 1.0), VectorXd::Ones(1));
    ASSERT_EQ(known.flat.size(), seen < 1.0 ? 1U : 0U) << seen;
    // Along a step of one prior deviation the row changes by slope · deviation.
    if (seen < 1.0) {
      EXPECT_NEAR(known.flat[0].change, seen, 1e-12);
    }
  }
}

// C = (J'J + D⁻²)⁻¹ inverted by Eigen, with unlike ranges and units.
TEST(Posterior, IsTheInverseOfTheSumOfPrecisions) {
  const Box box{Eigen::Vector2d(-1.0, -0.1), Eigen::Vector2d(2.0, 0.3)};
  const Eigen::Vector2d scale(5.0, 0.01), range = box.upper - box.lower;
  const MatrixXd j = three_by_two();
  const Eigen::Matrix2d precision =
      j.transpose() * j + Eigen::Matrix2d((12.0 * range.cwiseProduct(range).cwiseInverse()).asDiagonal());
  const Eigen::Matrix2d covariance = precision.inverse();
  const Posterior known = posterior(optimum(j), VectorXd::Zero(2), box, scale);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(known.std(a) / (scale(a) * std::sqrt(covariance(a, a))), 1.0, 1e-12);
  EXPECT_NEAR(known.correlation(0, 1), covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)), 1e-12);
  EXPECT_DOUBLE_EQ(known.correlation(1, 0), known.correlation(0, 1));
}

// Invariance: J'J, and so the covariance, does not change if whitened rows are turned by an orthogonal matrix.
TEST(Posterior, DoesNotChangeWithTurnedRows) {
  const MatrixXd j = three_by_two();
  const MatrixXd turn =
      MatrixXd(Eigen::HouseholderQR<MatrixXd>((MatrixXd(3, 3) << 1, 2, 3, 0, 1, 4, 5, 6, 0).finished()).householderQ());
  const auto of = [&](const MatrixXd& jacobian) {
    return posterior(optimum(jacobian), VectorXd::Zero(2), box_about_zero(2, 0.5), VectorXd::Ones(2));
  };
  const Posterior plain = of(j), turned = of(turn * j);
  EXPECT_LT((plain.std - turned.std).norm(), 1e-12);
  EXPECT_LT((plain.correlation - turned.correlation).norm(), 1e-12);
}

// Property: C is positive definite and below the prior, so 0 < std <= prior_std and |correlation| < 1.
TEST(Posterior, NeverKnowsLessThanThePrior) {
  const MatrixXd j = (MatrixXd(1, 3) << 40.0, -25.0, 0.3).finished();
  const Posterior known = posterior(optimum(j), VectorXd::Zero(3), box_about_zero(3, 0.5), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_TRUE((known.std.array() > 0.0).all());
  EXPECT_TRUE((known.std.array() <= known.prior_std.array() * (1.0 + 1e-12)).all());
  EXPECT_LT((known.correlation - MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 1.0);
  EXPECT_GT(known.correlation(0, 1), 0.9);  // slopes of unlike sign: one makes up for the other
  ASSERT_EQ(known.flat.size(), 2U);         // one row settles one direction of three
  EXPECT_LE(known.flat[0].change, known.flat[1].change + 1e-12);
}

// A parameter that its bound holds is a constant: the others are as if it were not there. Lower bound and upper bound.
TEST(Posterior, LeavesOutAParameterThatItsBoundHolds) {
  for (const double side : {-1.0, 1.0}) {
    Linearised at = optimum((MatrixXd(2, 2) << 2.0, 1.0, 0.0, 1.0).finished());
    at.residual = Eigen::Vector2d(0.0, -side);  // the gradient is (0, -side): downhill is out of the box
    const Eigen::Vector2d x(0.0, side);
    const Posterior known = posterior(at, x, box_about_zero(2, 1.0), Eigen::Vector2d::Ones());
    EXPECT_EQ(known.is_held, (std::vector<bool>{false, true}));
    EXPECT_NEAR(known.std(0), 1.0 / std::sqrt(4.0 + 3.0), 1e-12);  // 12 / range² = 3
    EXPECT_TRUE(std::isnan(known.std(1)));
    EXPECT_TRUE(std::isnan(known.correlation(0, 1)));
    EXPECT_EQ(known.degrees, 1);
    // On the bound, but pulled inside: free.
    at.residual = -at.residual;
    EXPECT_FALSE(posterior(at, x, box_about_zero(2, 1.0), Eigen::Vector2d::Ones()).is_held[1]);
  }
}

TEST(Posterior, OfHeldParametersAloneHasNoDeviation) {
  Linearised at = optimum(MatrixXd::Ones(3, 1));
  at.residual = VectorXd::Constant(3, -2.0);
  at.scales = 1;
  const Posterior known = posterior(at, VectorXd::Ones(1), box_about_zero(1, 1.0), VectorXd::Ones(1));
  EXPECT_TRUE(std::isnan(known.std(0)));
  EXPECT_TRUE(known.flat.empty());
  EXPECT_DOUBLE_EQ(known.chi_squared, 12.0);  // 3 · 2²
  EXPECT_EQ(known.degrees, 2);                // 3 rows less one scale
  EXPECT_DOUBLE_EQ(known.misfit(), std::sqrt(6.0));
}

// A good fit never narrows the intervals, and where nothing is left over it cannot be judged.
TEST(PosteriorMisfit, IsAtLeastOne) {
  Posterior known;
  known.degrees = 4, known.chi_squared = 1.0;
  EXPECT_DOUBLE_EQ(known.misfit(), 1.0);
  known.chi_squared = 36.0;
  EXPECT_DOUBLE_EQ(known.misfit(), 3.0);
  known.degrees = 0;
  EXPECT_DOUBLE_EQ(known.misfit(), 1.0);
  EXPECT_DOUBLE_EQ(known.chi_squared_score(), 0.0);
}

TEST(Posterior, DegreesAreNeverNegative) {
  const Posterior known =
      posterior(optimum(MatrixXd::Ones(1, 3)), VectorXd::Zero(3), box_about_zero(3, 1.0), VectorXd::Ones(3));
  EXPECT_EQ(known.degrees, 0);
}

// Hand calculation: (10, 0) and (-10, 0.9) differ by 0.9 from each other's line, (10, 1.1) by more than 1 standard deviation.
TEST(IndistinctSets, AreSplitAtOneStandardDeviation) {
  MatrixXd shifts(2, 2);
  shifts << 10.0, -10.0, 0.0, 0.9;
  EXPECT_EQ(indistinct_sets(shifts), (std::vector<std::vector<int>>{{0, 1}}));
  shifts << 10.0, -10.0, 0.0, 1.1;
  EXPECT_TRUE(indistinct_sets(shifts).empty());
  shifts << 0.9, 0.9, 0.0, 0.0;  // neither is seen at all
  EXPECT_TRUE(indistinct_sets(shifts).empty());
  EXPECT_TRUE(indistinct_sets(MatrixXd(2, 0)).empty());
}

// Invariance: b = (10, 0.8) cannot be told from a = (10, 0) nor from c = (10, 1.6), so all three are one set in any order.
TEST(IndistinctSets, DoNotDependOnTheOrderOfParameters) {
  MatrixXd shifts(2, 3);
  shifts << 10.0, 10.0, 10.0, 0.8, 0.0, 1.6;  // b, a, c
  EXPECT_EQ(indistinct_sets(shifts), (std::vector<std::vector<int>>{{0, 1, 2}}));
  shifts << 10.0, 10.0, 10.0, 0.0, 1.6, 0.8;  // a, c, b
  EXPECT_EQ(indistinct_sets(shifts), (std::vector<std::vector<int>>{{0, 1, 2}}));
}

// Two pairs along two axes, interleaved.
TEST(IndistinctSets, KeepPairsApart) {
  const MatrixXd shifts = (MatrixXd(2, 5) << 10.0, 0.0, 8.0, 0.0, 0.1, 0.0, 5.0, 0.0, -9.0, 0.1).finished();
  EXPECT_EQ(indistinct_sets(shifts), (std::vector<std::vector<int>>{{0, 2}, {1, 3}}));
}

}  // namespace
}  // namespace twindeck::updating
