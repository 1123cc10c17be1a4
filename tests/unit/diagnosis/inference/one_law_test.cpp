// The one law of a residual. Oracles: the density of a normal law from its dense covariance; sums over fine grids of the scales
// and of magnitudes; central differences.
#include "diagnosis/inference/one_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>

namespace twindeck::tests {
namespace {

using diagnosis::ErrorColumns;
using diagnosis::LawEvidence;
using diagnosis::LawHypothesis;
using diagnosis::LawSystem;
using diagnosis::OneLaw;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Sixty rows with two classes of errors of twenty-five columns each and one cause, drawn with known scales.
struct LawRows {
  LawSystem system;
  VectorXd cause;

  LawRows(unsigned seed, double first, double second, double size) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto draw = [&](Index rows, Index columns) {
      MatrixXd m(rows, columns);
      for (double& v : m.reshaped()) v = normal(random);
      return m;
    };
    constexpr Index n = 60, columns = 25;
    const MatrixXd root = draw(n, n) * 0.02;
    system.sigma = root * root.transpose() + 0.04 * MatrixXd::Identity(n, n);
    const MatrixXd one = draw(n, columns) * 0.3, other = draw(n, columns) * 0.3;
    system.classes = {ErrorColumns::of_columns(one), ErrorColumns::of_columns(other)};
    cause = draw(n, 1);
    const MatrixXd lower = system.sigma.llt().matrixL();
    system.residual = lower * draw(n, 1) + first * one * draw(columns, 1) + second * other * draw(columns, 1) + size * cause;
  }
  [[nodiscard]] LawHypothesis none() const { return {system.residual, VectorXd::Zero(1), {}, {}, {}, {{0, 1.0}, {1, 1.0}}}; }
  [[nodiscard]] double dense(const VectorXd& left, double first, double second) const {
    const MatrixXd sigma =
        system.sigma + first * first * system.classes[0].covariance + second * second * system.classes[1].covariance;
    return -0.5 * (left.dot(sigma.inverse() * left) + std::log(sigma.determinant()));
  }
};

double log_of_the_sum(const std::vector<double>& v) {
  const double top = *std::max_element(v.begin(), v.end());
  double sum = 0.0;
  for (const double x : v) sum += std::exp(x - top);
  return top + std::log(sum);
}

TEST(OneLaw, PriorsOfScalesHaveProbabilityOne) {
  for (const double spread : {0.0, 0.7}) {
    double sum = 0.0;
    constexpr double step = 0.01;
    for (double t = -25.0; t < 25.0; t += step)
      sum += step * std::exp(diagnosis::prior_of_scale({0, 0.3, spread}, t).log_density);
    EXPECT_NEAR(sum, 1.0, 1e-6);  // the tail beyond e^25 is e^-75 and below e^-25 as small as e^-24
  }
}

// Central differences.
TEST(OneLaw, PriorsOfScalesHaveTheirSlopeAndCurvature) {
  constexpr double h = 1e-4;
  for (const double spread : {0.0, 0.7})
    for (const double t : {-3.0, -1.0, 0.5, 2.0}) {
      const diagnosis::ActiveClass active{0, 0.3, spread};
      const auto at = [&](double x) { return diagnosis::prior_of_scale(active, x); };
      EXPECT_NEAR(at(t).slope, (at(t + h).log_density - at(t - h).log_density) / (2.0 * h), 1e-6);
      EXPECT_NEAR(at(t).curvature, -(at(t + h).slope - at(t - h).slope) / (2.0 * h), 1e-6);
    }
  EXPECT_NEAR(diagnosis::prior_of_scale({0, 0.3, 0.7}, std::log(0.3)).slope, 0.0, 1e-12);
}

TEST(OneLaw, DensityIsThatOfTheDenseCovariance) {
  const LawRows rows(1, 0.5, 1.5, 0.0);
  const OneLaw law(rows.system);
  LawHypothesis hypothesis = rows.none();
  hypothesis.left = (MatrixXd(60, 2) << rows.system.residual, rows.system.residual - 0.7 * rows.cause).finished();
  hypothesis.log_weight = VectorXd::Constant(2, std::log(0.5));
  const double expected = log_of_the_sum({std::log(0.5) + rows.dense(hypothesis.left.col(0), 0.4, 2.0),
                                          std::log(0.5) + rows.dense(hypothesis.left.col(1), 0.4, 2.0)}) +
                          diagnosis::prior_of_scale({}, std::log(0.4)).log_density +
                          diagnosis::prior_of_scale({}, std::log(2.0)).log_density;
  EXPECT_NEAR(law.log_posterior(hypothesis, Eigen::Vector2d(0.4, 2.0)), expected, 1e-8 * std::abs(expected));
}

TEST(OneLaw, ScoringEndsAtTheModeOfTheScales) {
  for (const unsigned seed : {2U, 3U, 4U}) {
    const LawRows rows(seed, 0.5, 1.5, 0.0);
    const OneLaw law(rows.system);
    const LawEvidence found = law.scored(rows.none(), Eigen::Vector2d(1.0, 1.0));
    ASSERT_TRUE(found.converged);
    // The scoring stops where a step promises a thousandth of a nat; values at a distance of a tenth in ln tau are lower.
    const double here = law.log_posterior(rows.none(), found.tau);
    for (const double step : {-0.1, 0.1})
      for (Index c = 0; c < 2; ++c) {
        VectorXd beside = found.tau;
        beside[c] *= std::exp(step);
        EXPECT_LT(law.log_posterior(rows.none(), beside), here);
      }
    // Another start leads to the same place.
    const LawEvidence again = law.scored(rows.none(), Eigen::Vector2d(0.05, 20.0));
    EXPECT_NEAR(again.log_evidence, found.log_evidence, 0.02);
    // Scales of 25 columns are known to about 1/sqrt(50) in ln tau: three of these deviations.
    EXPECT_NEAR(std::log(found.tau[0] / 0.5), 0.0, 0.75);
    EXPECT_NEAR(std::log(found.tau[1] / 1.5), 0.0, 0.45);
  }
}

TEST(OneLaw, EvidenceIsTheSumOverTheScales) {
  for (const unsigned seed : {5U, 6U}) {
    const LawRows rows(seed, 0.5, 1.5, 0.0);
    const OneLaw law(rows.system);
    const LawEvidence found = law.scored(rows.none(), Eigen::Vector2d(1.0, 1.0));
    constexpr double step = 0.1;
    std::vector<double> terms;
    for (double t = -5.0; t < 3.0; t += step)
      for (double u = -5.0; u < 3.0; u += step)
        terms.push_back(2.0 * std::log(step) + law.log_posterior(rows.none(), Eigen::Vector2d(std::exp(t), std::exp(u))));
    // Laplace's approximation of a law whose skewness is of order 1/sqrt(25): a third of a nat is what it may be off.
    EXPECT_NEAR(found.log_evidence, log_of_the_sum(terms), 0.3);
  }
}

TEST(OneLaw, LinearMagnitudesAreIntegratedBetweenTheirBounds) {
  const LawRows rows(7, 0.5, 1.0, 0.8);
  const OneLaw law(rows.system);
  LawHypothesis linear = rows.none();
  linear.slopes = rows.cause;
  linear.low = VectorXd::Constant(1, -1.0);
  linear.high = VectorXd::Constant(1, 3.0);
  const LawEvidence found = law.scored(linear, Eigen::Vector2d(1.0, 1.0));
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.shift[0], 0.8, 0.3);  // the rows know the size to about a tenth
  std::vector<double> terms;
  constexpr int count = 4000;
  for (int k = 0; k < count; ++k) {
    const double a = -1.0 + 4.0 * (k + 0.5) / count;
    terms.push_back(rows.dense(rows.system.residual - a * rows.cause, found.tau[0], found.tau[1]) - std::log(count));
  }
  const double prior = diagnosis::prior_of_scale({}, std::log(found.tau[0])).log_density +
                       diagnosis::prior_of_scale({}, std::log(found.tau[1])).log_density;
  // The term 2 pi / range² in the precision is a part in a thousand of it here.
  EXPECT_NEAR(law.log_posterior(linear, found.tau), log_of_the_sum(terms) + prior, 5e-3);
}

TEST(ErrorColumns, AreNoMoreThanTheRows) {
  MatrixXd many(3, 7);
  many << 1, 0, 2, 0, 1, 0, 3, 0, 0, 1, 2, 1, 0, 1, 4, 0, 0, 1, 1, 0, 2;
  const ErrorColumns found = ErrorColumns::of_columns(many);
  EXPECT_EQ(found.columns.cols(), 3);
  EXPECT_LT((found.covariance - many * many.transpose()).norm(), 1e-12);
  MatrixXd none_of_one_row = MatrixXd::Zero(3, 3);
  none_of_one_row(0, 0) = none_of_one_row(2, 2) = none_of_one_row(0, 2) = none_of_one_row(2, 0) = 2.0;  // of rank one
  const ErrorColumns flat = ErrorColumns::of_covariance(none_of_one_row);
  EXPECT_EQ(flat.columns.row(1).norm(), 0.0);
  EXPECT_LT((flat.columns * flat.columns.transpose() - none_of_one_row).norm(), 1e-12);
  EXPECT_LT((found.columns * found.columns.transpose() - found.covariance).norm(), 1e-12 * found.covariance.norm());
  EXPECT_TRUE(ErrorColumns::of_columns(MatrixXd(3, 0)).empty());
  const ErrorColumns nothing = ErrorColumns::of_covariance(MatrixXd::Zero(3, 3));
  EXPECT_EQ(nothing.columns.cols(), 0);
  EXPECT_EQ(nothing.covariance.norm(), 0.0);
}

TEST(OneLaw, AnAbsentClassIsNotThere) {
  const LawRows rows(8, 0.5, 0.0, 0.0);
  LawSystem fewer = rows.system;
  fewer.classes.pop_back();
  LawHypothesis first = rows.none();
  first.active = {{0, 1.0}};
  const LawEvidence with = OneLaw(rows.system).scored(first, Eigen::Vector2d(1.0, 1.0));
  const LawEvidence without = OneLaw(fewer).scored(first, VectorXd::Ones(1));
  EXPECT_EQ(with.tau[1], 0.0);
  EXPECT_NEAR(with.log_evidence, without.log_evidence, 1e-9);
}

}  // namespace
}  // namespace twindeck::tests
