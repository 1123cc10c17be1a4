// The evidence with a form error. Oracles: dense covariances assembled and factorised as they stand; integrals over an unknown
// by quadrature; densities that integrate to one over all data; Student's law of three degrees of freedom by quadrature.
#include "diagnosis/inference/form_evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

namespace twindeck::tests {
namespace {

using diagnosis::FormEvidence;
using diagnosis::FormSystem;
using diagnosis::Quadratic;
using diagnosis::ScaleGrid;
using diagnosis::ScalePoint;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Problem {
  FormSystem system;
  MatrixXd sigma;
};

/// A random system of 18 rows. @param correlated  Sigma_0 couples rows of different kinks
Problem random_problem(unsigned seed, bool correlated) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&](Index rows, Index cols) {
    MatrixXd m(rows, cols);
    for (double& v : m.reshaped()) v = normal(random);
    return m;
  };
  constexpr Index n = 18;
  Problem p;
  p.sigma = MatrixXd::Identity(n, n) * 0.01;
  for (Index i = 0; i < n; ++i) p.sigma(i, i) *= 1.0 + 0.5 * std::abs(normal(random));
  if (correlated) {
    const MatrixXd b = 0.05 * draw(n, 3);
    p.sigma += b * b.transpose();
  }
  p.system.sigma_factor = p.sigma.llt().matrixL();
  p.system.fixed = 0.2 * draw(n, 3);
  p.system.scatter = 0.1 * draw(n, 2);
  p.system.frequency = draw(n, 2);
  p.system.shape = draw(n, 4);
  p.system.kinks = MatrixXd::Zero(n, 5);
  for (Index r = 0; r < 15; ++r)
    p.system.kinks(r, r % 5) = 2.0 + 0.1 * static_cast<double>(r);  // three conditions of five channels
  p.system.change = {{draw(n, 3), {1, 2}}, {draw(n, 2), {0}}};
  p.system.residual = draw(n, 1);
  p.system.signatures = draw(n, 3);
  p.system.all_products = true;
  return p;
}

MatrixXd dense_covariance(const Problem& p, const ScaleGrid& grid, const ScalePoint& point, int contrast, double kappa) {
  const double f = grid.frequency[point.frequency], s = grid.shape[point.shape];
  const auto square = [](const MatrixXd& m) -> MatrixXd { return m * m.transpose(); };
  MatrixXd sigma = p.sigma + square(p.system.fixed) + point.scatter * point.scatter * square(p.system.scatter) +
                   f * f * square(p.system.frequency) + s * s * (square(p.system.shape) + square(p.system.kinks));
  if (contrast >= 0) sigma += kappa * kappa * square(p.system.change[static_cast<std::size_t>(contrast)].columns);
  return sigma;
}

void expect_dense(const Quadratic& q, const MatrixXd& sigma, const Problem& p, const std::vector<int>& asked) {
  const Eigen::LLT<MatrixXd> factor(sigma);
  const MatrixXd lower = factor.matrixL();
  EXPECT_NEAR(q.log_determinant, 2.0 * lower.diagonal().array().log().sum(), 1e-8);
  const VectorXd solved = factor.solve(p.system.residual);
  EXPECT_NEAR(q.chi_squared / p.system.residual.dot(solved), 1.0, 1e-8);
  const MatrixXd s = p.system.signatures(Eigen::all, asked), solved_s = factor.solve(s);
  ASSERT_EQ(q.along.size(), s.cols());
  const double size = 1.0 + (s.transpose() * solved_s).cwiseAbs().maxCoeff();
  EXPECT_LT((q.along - s.transpose() * solved).cwiseAbs().maxCoeff() / size, 1e-8);
  EXPECT_LT((q.products - s.transpose() * solved_s).cwiseAbs().maxCoeff() / size, 1e-8);
  EXPECT_LT((q.square - (s.transpose() * solved_s).diagonal()).cwiseAbs().maxCoeff() / size, 1e-8);
  for (Index k = 0; k < s.cols(); ++k) {
    const VectorXd left = p.system.residual - 0.7 * s.col(k);
    EXPECT_NEAR(q.remaining(k, 0.7) / left.dot(factor.solve(left)), 1.0, 1e-7);
    EXPECT_NEAR(q.log_density(k, 0.7), -0.5 * (left.dot(factor.solve(left)) + q.log_determinant), 1e-6 * size);
  }
}

TEST(FormEvidence, RowsThatAreTooExactForSixteenDigitsAreKnown) {
  Problem p = random_problem(3, false);
  EXPECT_TRUE(diagnosis::can_be_weighed(p.system));
  p.system.sigma_factor *= 1e-4;
  EXPECT_TRUE(diagnosis::can_be_weighed(p.system));
  p.system.sigma_factor *= 1e-3;
  EXPECT_FALSE(diagnosis::can_be_weighed(p.system));
  p = random_problem(3, false);
  p.system.scatter(0, 0) = std::nan("");
  EXPECT_FALSE(diagnosis::can_be_weighed(p.system));
}

TEST(FormEvidence, EveryPointIsTheDenseCovariance) {
  const ScaleGrid grid = diagnosis::scale_grid();
  for (const bool correlated : {false, true}) {
    const Problem p = random_problem(correlated ? 2 : 1, correlated);
    const FormEvidence evidence(p.system, grid);
    for (const ScalePoint& point : grid.points) {
      const diagnosis::AtScales at = evidence.at(point);
      expect_dense(at.without, dense_covariance(p, grid, point, -1, 0.0), p, {0, 1, 2});
      for (int c = 0; c < 2; ++c)
        for (Index k = 0; k < grid.change.size(); ++k)
          expect_dense(at.change[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)],
                       dense_covariance(p, grid, point, c, grid.change[k]), p,
                       p.system.change[static_cast<std::size_t>(c)].signatures);
    }
  }
}

TEST(FormEvidence, EliminatedKinksAreUnknownsOfTheSystem) {
  // The same columns among those that tau_s scales: one as part of the system, one eliminated beforehand.
  const ScaleGrid grid = diagnosis::scale_grid();
  for (const bool correlated : {false, true}) {
    const Problem p = random_problem(7, correlated);
    FormSystem full = p.system;
    full.shape.resize(p.system.shape.rows(), p.system.shape.cols() + p.system.kinks.cols());
    full.shape << p.system.shape, p.system.kinks;
    full.kinks.resize(p.system.kinks.rows(), 0);
    const FormEvidence eliminated(p.system, grid), whole(full, grid);
    for (const ScalePoint& point : grid.points) {
      const Quadratic a = eliminated.at(point).without, b = whole.at(point).without;
      EXPECT_NEAR(a.log_determinant, b.log_determinant, 1e-8);
      EXPECT_NEAR(a.chi_squared / b.chi_squared, 1.0, 1e-8);
      EXPECT_LT((a.products - b.products).cwiseAbs().maxCoeff(), 1e-7 * b.products.cwiseAbs().maxCoeff());
    }
  }
}

TEST(FormEvidence, IsTheIntegralOverTheUnknowns) {
  // Two rows, one unknown of the form error and one kink: N(r; tau (f d + k v), Sigma_0) over d and v by the trapezoidal rule.
  FormSystem system;
  MatrixXd sigma(2, 2);
  sigma << 0.04, 0.01, 0.01, 0.02;
  system.sigma_factor = sigma.llt().matrixL();
  system.fixed = system.scatter = system.shape = MatrixXd::Zero(2, 0);
  system.frequency = Eigen::Vector2d(8.0, -3.0);
  system.kinks = Eigen::Vector2d(1.0, 5.0);
  system.residual = Eigen::Vector2d(0.15, 0.4);
  system.signatures = MatrixXd::Zero(2, 0);
  const ScaleGrid grid = diagnosis::scale_grid();
  const ScalePoint point{1.0, 4, 2, 0.0};
  const double f = grid.frequency[4], s = grid.shape[2];
  const MatrixXd inverse = sigma.inverse();
  double sum = 0.0;
  constexpr double step = 0.02;
  for (double d = -8.0; d <= 8.0; d += step)
    for (double v = -8.0; v <= 8.0; v += step) {
      const Eigen::Vector2d left = system.residual - f * d * system.frequency - s * v * system.kinks;
      sum += step * step * std::exp(-0.5 * (d * d + v * v + left.dot(inverse * left))) / (2.0 * std::numbers::pi);
    }
  sum /= std::sqrt(sigma.determinant());  // the 2 pi of the rows is left out of log_density
  EXPECT_NEAR(FormEvidence(system, grid).at(point).without.log_density(), std::log(sum), 1e-6);
}

TEST(FormEvidence, HypothesesAreDensitiesOfTheData) {
  // One row: every hypothesis, its scales summed over, integrates to one over all values that the row could have had.
  const ScaleGrid grid = diagnosis::scale_grid();
  const VectorXd kappa_prior = diagnosis::half_t_weights(grid.change, 0.03);
  double none = 0.0, cause = 0.0, change = 0.0;
  constexpr double step = 0.005;
  for (double r = -6.0; r <= 6.0; r += step) {
    FormSystem system;
    system.sigma_factor = MatrixXd::Constant(1, 1, 0.02);
    system.fixed = system.shape = system.kinks = MatrixXd::Zero(1, 0);
    system.scatter = MatrixXd::Constant(1, 1, 0.02);
    system.frequency = MatrixXd::Constant(1, 1, 1.0);
    system.change = {{MatrixXd::Constant(1, 1, 1.0), {0}}};
    system.residual = VectorXd::Constant(1, r);
    system.signatures = MatrixXd::Constant(1, 1, 0.3);
    const FormEvidence evidence(system, grid);
    std::vector<diagnosis::EvidenceTerm> of_none, of_cause, of_change;
    for (std::size_t p = 0; p < grid.points.size(); ++p) {
      const auto at = evidence.at(grid.points[p]);
      const double prior = grid.points[p].log_prior;
      of_none.push_back({prior + at.without.log_density(), static_cast<int>(p), -1, 0.0});
      of_cause.push_back({prior + at.without.log_density(0), static_cast<int>(p), -1, 0.0});
      for (int k = 0; k < kappa_prior.size(); ++k)
        of_change.push_back({prior + std::log(kappa_prior[k]) + at.change[0][static_cast<std::size_t>(k)].log_density(),
                             static_cast<int>(p), k, 0.0});
    }
    const double part = step / std::sqrt(2.0 * std::numbers::pi);
    none += part * std::exp(diagnosis::summed(of_none, grid).log_evidence);
    cause += part * std::exp(diagnosis::summed(of_cause, grid).log_evidence);
    change += part * std::exp(diagnosis::summed(of_change, grid).log_evidence);
  }
  EXPECT_NEAR(none, 1.0, 1e-6);
  EXPECT_NEAR(cause, 1.0, 1e-6);
  EXPECT_NEAR(change, 1.0, 1e-6);
}

TEST(FormEvidence, SumsAreLogarithmsOfSumsAndProbabilitiesSumToOne) {
  const ScaleGrid grid = diagnosis::scale_grid();
  std::vector<diagnosis::EvidenceTerm> terms;
  double sum = 0.0;
  for (int p = 0; p < static_cast<int>(grid.points.size()); ++p) {
    terms.push_back({-200.0 + 0.1 * p, p, p % 6, 1.0 * p});
    sum += std::exp(0.1 * p);
  }
  const auto found = diagnosis::summed(terms, grid);
  EXPECT_NEAR(found.log_evidence, -200.0 + std::log(sum), 1e-10);
  EXPECT_NEAR(found.frequency.sum(), 1.0, 1e-12);
  EXPECT_NEAR(found.shape.sum(), 1.0, 1e-12);
  EXPECT_EQ(found.best.point, static_cast<int>(grid.points.size()) - 1);
  EXPECT_GT(found.kappa, grid.change[0]);
  EXPECT_LT(found.kappa, grid.change[5]);
}

TEST(ScaleGrid, PriorsAreThoseOfTheHalfTLaw) {
  const ScaleGrid grid = diagnosis::scale_grid();
  EXPECT_EQ(grid.points.size(), 60u);
  double sum = 0.0;
  for (const ScalePoint& point : grid.points) sum += std::exp(point.log_prior);
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // Student's density with three degrees of freedom, twice over the positive half.
  const auto density = [](double t) {
    return 2.0 * 2.0 / (std::numbers::pi * std::sqrt(3.0)) / std::pow(1.0 + t * t / 3.0, 2);
  };
  const VectorXd weight = diagnosis::half_t_weights(grid.frequency, 0.01);
  double low = 0.0;
  for (Index i = 0; i + 1 < weight.size(); ++i) {
    const double high = std::sqrt(grid.frequency[i] * grid.frequency[i + 1]) / 0.01;
    double integral = 0.0;
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) integral += density(low + (high - low) * (k + 0.5) / steps) * (high - low) / steps;
    EXPECT_NEAR(weight[i], integral, 1e-8) << i;
    low = high;
  }
  EXPECT_NEAR(weight.sum(), 1.0, 1e-12);
}

TEST(ScaleEstimate, OfOneCellLiesWithinItAndTheEndIsSeen) {
  const ScaleGrid grid = diagnosis::scale_grid();
  VectorXd probability = VectorXd::Zero(6);
  probability[3] = 1.0;
  const auto middle = diagnosis::estimate(grid.frequency, probability);
  EXPECT_NEAR(middle.level, 0.012, 1e-12);
  EXPECT_GT(middle.low, std::sqrt(0.005 * 0.012));
  EXPECT_LT(middle.low, middle.level);
  EXPECT_GT(middle.high, middle.level);
  EXPECT_LT(middle.high, std::sqrt(0.012 * 0.03));
  EXPECT_FALSE(middle.at_end);
  probability << 0.0, 0.0, 0.0, 0.0, 0.4, 0.6;
  EXPECT_TRUE(diagnosis::estimate(grid.frequency, probability).at_end);
}

}  // namespace
}  // namespace twindeck::tests
