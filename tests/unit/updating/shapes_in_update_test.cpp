// Updates that weigh shapes. Oracles: the parameters that the measurement was computed from; the full search beside that on the
// reduced system; the spread of the estimates over drawn noise beside the deviations that are told.
#include <gtest/gtest.h>

#include "shaped_chain.hpp"
#include "updating/posterior.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {
namespace {

constexpr int kTwinMasses = 9;
const Eigen::Vector2d kSoftLeft(0.7, 1.0);
const std::vector<int> kSeen = {0, 2, 3, 6, 8};

UpdatingResult shaped_update(const fe::ParametricSystem& system, const ShapedMeasurement& measurement, int n_starts,
                             Eigen::Index surrogate_from = 1000, bool leave_one_out = false) {
  UpdatingOptions options;
  options.starts = n_starts;
  options.n_modes = 7;
  options.surrogate_from_size = surrogate_from;
  options.leave_one_out = leave_one_out;
  return update(system, {}, {0, 1}, measurement.targets, options, {}, measurement.rows);
}

Posterior posterior_of(const UpdatingResult& result) {
  return posterior(result.at_optimum, result.theta.cwiseQuotient(result.scale), result.box, result.scale);
}

TEST(ShapesInUpdate, TellTwinsApartThatFrequenciesCannot) {
  const fe::ParametricSystem system = twin_chain(kTwinMasses, 0.4, 1.6).system();
  ShapedMeasurement measurement = measure_chain(system, kSoftLeft, kSeen, 5, 1e-3, 0.01, nullptr);
  UpdatingOptions options;
  options.starts = 8;
  const UpdatingResult frequencies = update(system, {}, {0, 1}, measurement.targets, options, {});
  ASSERT_EQ(frequencies.optima.size(), 2U) << "either twin may be the soft one";

  const UpdatingResult result = shaped_update(system, measurement, 8);
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_LT((result.theta - kSoftLeft).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(result.starts[static_cast<std::size_t>(result.best)].cost, 1e-6);
  for (const int k : result.optima) {
    if (k != result.starts[static_cast<std::size_t>(result.best)].optimum) {
      EXPECT_GT(result.starts[static_cast<std::size_t>(k)].cost, 100.0);
    }
  }
  EXPECT_GT(result.cost_before, 100.0);
}

// A factor on all standard deviations changes what the cost is counted in, nothing else. Oracle: the history with the
// deviations as measured, step by step.
TEST(ShapesInUpdate, IsTheSameSearchForAFactorOnAllDeviations) {
  const fe::ParametricSystem system = twin_chain(kTwinMasses, 0.4, 1.6).system();
  std::mt19937_64 noise(5);
  const ShapedMeasurement measured = measure_chain(system, kSoftLeft, kSeen, 5, 1e-3, 0.01, &noise);
  for (const Eigen::Index surrogate_from : {1000, 0}) {
    const UpdatingResult as_measured = shaped_update(system, measured, 8, surrogate_from);
    for (const double factor : {0.1, 0.01}) {
      ShapedMeasurement smaller = measured;
      smaller.rows.covariance *= factor * factor;
      const UpdatingResult result = shaped_update(system, smaller, 8, surrogate_from);
      EXPECT_TRUE(result.status.converged) << factor << ": " << result.status.message;
      ASSERT_EQ(result.history.size(), as_measured.history.size()) << factor;
      for (std::size_t i = 0; i < result.history.size(); ++i)
        EXPECT_LT((result.history[i].theta - as_measured.history[i].theta).norm(), 1e-8) << factor << ", record " << i;
      for (std::size_t k = 0; k < result.starts.size(); ++k)
        EXPECT_EQ(result.starts[k].converged, as_measured.starts[k].converged) << factor << ", start " << k;
    }
  }
}

TEST(ShapesInUpdate, OnTheReducedSystemEndWhereTheFullSearchEnds) {
  const fe::ParametricSystem system = twin_chain(31, 0.6, 1.4).system();
  std::mt19937_64 noise(11);
  const ShapedMeasurement measurement =
      measure_chain(system, Eigen::Vector2d(0.85, 1.1), {1, 4, 9, 14, 20, 25, 29}, 5, 1e-3, 0.01, &noise);
  const UpdatingResult full = shaped_update(system, measurement, 3), reduced = shaped_update(system, measurement, 3, 0);
  ASSERT_TRUE(full.status.converged) << full.status.message;
  ASSERT_TRUE(reduced.status.converged) << reduced.status.message;
  EXPECT_LT((full.theta - reduced.theta).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(full.at_optimum.residual.squaredNorm(), reduced.at_optimum.residual.squaredNorm(), 1e-6);
}

TEST(ShapesInUpdate, ALeftOutModeIsPredictedByTheOthers) {
  const fe::ParametricSystem system = twin_chain(kTwinMasses, 0.4, 1.6).system();
  ShapedMeasurement measurement = measure_chain(system, kSoftLeft, kSeen, 4, 1e-3, 0.01, nullptr);
  const double right = measurement.targets[2].measured_Hz;
  measurement.targets[2].measured_Hz *= 1.05;
  const UpdatingResult result = shaped_update(system, measurement, 4, 1000, true);
  ASSERT_EQ(result.left_out.size(), 4U);
  EXPECT_NEAR(result.left_out[2].frequency_Hz / right, 1.0, 1e-6);
  EXPECT_LT((result.left_out[2].theta - kSoftLeft).cwiseAbs().maxCoeff(), 1e-5);
}

// Two parameters and sixty draws: the mean square of 120 normalised errors has a standard deviation of 0.13, that of chi² over
// its degrees of freedom (25 a draw) one of 0.04; limits at three of them.
TEST(Posterior, DeviationsAreThoseOfTheEstimatesOverDrawnNoise) {
  const fe::ParametricSystem system = twin_chain(kTwinMasses, 0.3, 1.7).system();
  double squares = 0.0, chi_squared = 0.0;
  constexpr int draws = 60;
  int degrees = 0;
  for (int draw = 0; draw < draws; ++draw) {
    std::mt19937_64 noise(1000 + static_cast<unsigned>(draw));
    const UpdatingResult result = shaped_update(system, measure_chain(system, kSoftLeft, kSeen, 5, 2e-3, 0.01, &noise), 1);
    ASSERT_TRUE(result.status.converged) << result.status.message;
    const Posterior known = posterior_of(result);
    squares += (result.theta - kSoftLeft).cwiseQuotient(known.std).squaredNorm() / (2.0 * draws);
    chi_squared += known.chi_squared / draws;
    degrees = known.degrees;
  }
  EXPECT_EQ(degrees, 5 + 5 * 5 - 5 - 2);
  EXPECT_NEAR(squares, 1.0, 0.39);
  EXPECT_NEAR(chi_squared / degrees, 1.0, 0.12);
}

TEST(Posterior, MeetsTheClosedFormOfALinearProblem) {
  Linearised at;
  at.residual = Eigen::Vector3d(0.0, 0.0, 1.0);
  at.jacobian = Eigen::MatrixXd::Zero(3, 3);
  at.jacobian << 2.0, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -5.0;  // the third pushes against its upper bound
  const double range = std::sqrt(12.0);                         // a prior deviation of 1
  const Box box{Eigen::Vector3d(-range / 2, -range / 2, -range), Eigen::Vector3d(range / 2, range / 2, 0.0)};
  const Posterior known = posterior(at, Eigen::Vector3d::Zero(), box, Eigen::Vector3d(1.0, 10.0, 1.0));
  Eigen::Matrix2d precision;
  precision << 4.0 + 1.0, 4.0, 4.0, 4.0 + 1.0 + 1.0;
  const Eigen::Matrix2d covariance = precision.inverse();
  EXPECT_NEAR(known.std(0), std::sqrt(covariance(0, 0)), 1e-12);
  EXPECT_NEAR(known.std(1), 10.0 * std::sqrt(covariance(1, 1)), 1e-12);
  EXPECT_NEAR(known.correlation(0, 1), covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)), 1e-12);
  EXPECT_EQ(known.is_held, (std::vector<bool>{false, false, true}));
  EXPECT_TRUE(std::isnan(known.std(2)));
  EXPECT_EQ(known.degrees, 1);
  EXPECT_DOUBLE_EQ(known.chi_squared, 1.0);
}

TEST(Posterior, NamesTheFlatDirectionOfTwins) {
  Linearised at;
  at.residual = Eigen::Vector2d::Zero();
  at.jacobian = Eigen::MatrixXd(2, 3);
  at.jacobian << 50.0, 50.0, 3.0, 20.0, 20.0, -30.0;
  const Box box{Eigen::Vector3d::Constant(0.5), Eigen::Vector3d::Constant(1.5)};
  const Posterior known = posterior(at, Eigen::Vector3d::Ones(), box, Eigen::Vector3d::Ones());
  ASSERT_EQ(known.flat.size(), 1U);
  const double step = std::sqrt(0.5) * known.prior_std(0);
  EXPECT_NEAR(std::abs(known.flat[0].step(0)), step, 1e-9);
  EXPECT_NEAR(known.flat[0].step(0) + known.flat[0].step(1), 0.0, 1e-9);
  EXPECT_NEAR(known.flat[0].change, 0.0, 1e-9);
  EXPECT_LT(known.correlation(0, 1), -0.99);
  EXPECT_EQ(indistinct_sets(at.jacobian), (std::vector<std::vector<int>>{{0, 1}}));
}

// Quantiles of chi² from tables: 18.47 is exceeded by one in a hundred at 7 degrees of freedom, 4.351 is the median at 5.
TEST(Posterior, ScoresChiSquared) {
  Posterior known;
  known.degrees = 7, known.chi_squared = 18.475;
  EXPECT_NEAR(known.chi_squared_score(), 2.326, 0.03);
  known.degrees = 5, known.chi_squared = 4.351;
  EXPECT_NEAR(known.chi_squared_score(), 0.0, 0.03);
}

}  // namespace
}  // namespace twindeck::updating
