// Oracles: hand calculations on factors that are chosen; the covariance of a mean for independent blocks (closed form); the
// spread over records of one system.
#include "identification/uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "chain.hpp"
#include "core/error.hpp"
#include "identification/ssi_cov.hpp"

namespace twindeck::identification {
namespace {

Pole pole_of_model(int order, double omega, const Eigen::Vector2cd& shape) {
  Pole pole;
  pole.order = order;
  pole.eigenvalue = {-0.1, omega};
  pole.shape = shape;
  return pole;
}

/// Three orders of one pole each and their factors: two changes, rows f, zeta, Re, Re, Im, Im.
struct ChosenFactors {
  ShiftModels models;
  PoleFactors factors;
  std::vector<Pole> mode;
};

ChosenFactors three_orders(const std::vector<double>& phases) {
  ChosenFactors chosen;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2cd shape = Eigen::Vector2cd(0.6, 0.8) * std::polar(1.0, phases[static_cast<std::size_t>(k)]);
    chosen.mode.push_back(pole_of_model(2 + 2 * k, 5.0 + k, shape));
    OrderModel model;
    model.order = 2 + 2 * k;
    model.poles = {pole_of_model(2 + 2 * k, 50.0, shape), chosen.mode.back()};  // the second is meant
    chosen.models.orders.push_back(model);
    Eigen::MatrixXd factor(6, 2);
    factor << 3.0, 4.0, 0.01, 0.02, 0.3, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0;
    // The changes of a turned shape are turned with it.
    const Eigen::MatrixXcd turned = factor.middleRows(2, 2) * std::polar(1.0, phases[static_cast<std::size_t>(k)]);
    factor.middleRows(2, 2) = turned.real();
    factor.bottomRows(2) = turned.imag();
    chosen.factors.of.push_back({Eigen::MatrixXd::Constant(6, 2, 77.0), factor});
  }
  return chosen;
}

// sqrt(3² + 4²) = 5, and 0 between a pole and itself.
TEST(Uncertainty, ADeviationIsTheRootOfTheSumOfSquares) {
  ChosenFactors chosen = three_orders({0.0, 0.0, 0.0});
  EXPECT_NEAR(frequency_deviation(chosen.models, chosen.factors, chosen.mode[0]), 5.0, 1e-15);
  EXPECT_NEAR(difference_deviation(chosen.models, chosen.factors, chosen.mode[0], chosen.mode[0]), 0.0, 1e-15);
  // (3, 4) - (3, -8) = (0, 12): the difference of two that move against each other.
  chosen.factors.of[1][1](0, 1) = -8.0;
  EXPECT_NEAR(difference_deviation(chosen.models, chosen.factors, chosen.mode[0], chosen.mode[1]), 12.0, 1e-14);
}

// Shapes of three orders with phases of their own: turned to the first, their changes are the same.
TEST(Uncertainty, ChangesOfShapesAreTurnedToTheFirstMember) {
  for (const auto& phases : std::vector<std::vector<double>>{{0.0, 0.0, 0.0}, {0.0, 1.2, -2.5}}) {
    const ChosenFactors chosen = three_orders(phases);
    const auto deviations = mode_deviations(chosen.models, chosen.factors, {chosen.mode});
    ASSERT_EQ(deviations.size(), 1U);
    EXPECT_NEAR(deviations[0].frequency_Hz, 5.0, 1e-14);
    EXPECT_NEAR(deviations[0].damping_ratio, std::hypot(0.01, 0.02), 1e-15);
    EXPECT_LT((deviations[0].shape_real - Eigen::Vector2d(0.3, 0.2)).norm(), 1e-14);
    EXPECT_LT(deviations[0].shape_imag.norm(), 1e-14);
    EXPECT_EQ(deviations[0].factor.rows(), 6);
    EXPECT_EQ(deviations[0].factor.cols(), 2);
  }
}

// The frequencies' changes of three orders are 3, 9 and 100: their median is 9.
TEST(Uncertainty, OfTheMembersChangesTheMedianCounts) {
  ChosenFactors chosen = three_orders({0.0, 0.0, 0.0});
  chosen.factors.of[1][1](0, 0) = 100.0;
  chosen.factors.of[2][1](0, 0) = 9.0;
  const auto deviations = mode_deviations(chosen.models, chosen.factors, {chosen.mode, {chosen.mode[1]}});
  ASSERT_EQ(deviations.size(), 2U);
  EXPECT_NEAR(deviations[0].frequency_Hz, std::hypot(9.0, 4.0), 1e-14);
  EXPECT_NEAR(deviations[1].frequency_Hz, std::hypot(100.0, 4.0), 1e-13);
}

TEST(Uncertainty, APoleThatNoModelHasIsOurMistake) {
  const ChosenFactors chosen = three_orders({0.0, 0.0, 0.0});
  Pole stranger = chosen.mode[0];
  stranger.order = 20;
  EXPECT_THROW(static_cast<void>(frequency_deviation(chosen.models, chosen.factors, stranger)), InternalError);
  stranger = chosen.mode[0];
  stranger.eigenvalue += 1e-9;
  EXPECT_THROW(static_cast<void>(frequency_deviation(chosen.models, chosen.factors, stranger)), InternalError);
}

/// One channel, one lag, blocks with these means and counts.
signal::BlockCorrelations blocks_with(const Eigen::RowVectorXd& means, const Eigen::RowVectorXd& counts) {
  signal::BlockCorrelations blocks;
  blocks.n_outputs = blocks.n_references = blocks.n_lags = 1;
  blocks.counts = counts;
  blocks.sums = means.cwiseProduct(counts);
  return blocks;
}

// Equal blocks: the variance of a mean, sum (R_b - R)² / (n (n - 1)). Means 1, 2, 6: (4 + 1 + 9) / 6.
TEST(LagChange, EqualBlocksGiveTheVarianceOfAMean) {
  const auto blocks = blocks_with(Eigen::RowVector3d(1.0, 2.0, 6.0), Eigen::RowVector3d::Constant(10.0));
  double variance = 0.0, sum = 0.0;
  for (Eigen::Index b = 0; b < 3; ++b) {
    const double change = lag_change(blocks, blocks.mean(), b).front()(0, 0);
    variance += change * change;
    sum += change;
  }
  EXPECT_NEAR(variance, 14.0 / 6.0, 1e-14);
  EXPECT_NEAR(sum, 0.0, 1e-14);  // the changes are about the mean
}

// Shares 1/6, 2/6, 3/6 of the products: w_b sqrt(3/2) (R_b - R) with R = (1 + 4 + 18)/6 = 23/6.
TEST(LagChange, ABlockCountsByItsShareOfTheProducts) {
  const auto blocks = blocks_with(Eigen::RowVector3d(1.0, 2.0, 6.0), Eigen::RowVector3d(10.0, 20.0, 30.0));
  const std::vector<double> expected = {1.0 / 6.0 * (1.0 - 23.0 / 6.0), 2.0 / 6.0 * (2.0 - 23.0 / 6.0),
                                        3.0 / 6.0 * (6.0 - 23.0 / 6.0)};
  for (Eigen::Index b = 0; b < 3; ++b) {
    EXPECT_NEAR(lag_change(blocks, blocks.mean(), b).front()(0, 0), std::sqrt(1.5) * expected[static_cast<std::size_t>(b)],
                1e-14);
  }
}

// Outputs, references and lags are in their places: in `sums` the lag is slowest, then the reference, then the output.
TEST(LagChange, EntriesAreInTheirPlaces) {
  signal::BlockCorrelations blocks;
  blocks.n_outputs = 3;
  blocks.n_references = 2;
  blocks.n_lags = 2;
  blocks.counts = Eigen::MatrixXd::Ones(2, 2);
  blocks.sums = Eigen::MatrixXd::Zero(12, 2);
  blocks.sums(6 + 3 + 2, 0) = 1.0;  // lag 1, reference 1, output 2; only in the first block
  const auto change = lag_change(blocks, blocks.mean(), 0);
  ASSERT_EQ(change.size(), 2U);
  EXPECT_EQ(change[0].norm(), 0.0);
  // Mean 1/2, share 1/2: 1/2 · sqrt(2) · (1 - 1/2).
  EXPECT_NEAR(change[1](2, 1), 0.25 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(change[1].norm(), 0.25 * std::sqrt(2.0), 1e-15);
}

TEST(CovarianceChanges, OneBlockHasNoScatter) {
  const auto blocks = blocks_with(Eigen::RowVectorXd::Constant(1, 1.0), Eigen::RowVectorXd::Constant(1, 5.0));
  EXPECT_THROW(static_cast<void>(covariance_changes(blocks, 1, {}, {})), InternalError);
}

struct OfRecord {
  Pole pole;
  ModeDeviation deviation;
};

/// The first mode of a chain of two masses, from one record: 250 cycles in 20 blocks.
OfRecord first_mode_of_record(std::uint64_t seed, double gain) {
  const test::Chain chain(2, 10.0, 0.02, 10.0);
  const Eigen::Index p = 10;
  const auto blocks = signal::correlations(chain.simulate(2500, seed, 0.0) * gain, {0, 1}, 2 * p, 20);
  const Observability o = ssi_cov(blocks.mean(), p, 2, 4);
  const ShiftModels models = shift_models(o, {4}, 10.0);
  const PoleFactors factors = pole_factors(o, models, covariance_changes(blocks, p, o, models));
  const Pole pole = models.orders.front().poles.front();
  return {pole, mode_deviations(models, factors, {{pole}}).front()};
}

// 100 records: the spread of 100 values is known to 7 %, and the mean of estimated variances from 20 blocks that are as long as
// some decay times has a bias of 10 to 20 %. A factor of sqrt(2) is beyond both.
TEST(CovarianceChanges, DeviationsAreTheSpreadOverRecords) {
  const int n = 100;
  Eigen::ArrayXd frequency(n), damping(n), frequency_variance(n), damping_variance(n);
  for (int i = 0; i < n; ++i) {
    const OfRecord of = first_mode_of_record(static_cast<std::uint64_t>(500 + i), 1.0);
    frequency[i] = of.pole.frequency_Hz;
    damping[i] = of.pole.damping_ratio;
    frequency_variance[i] = std::pow(of.deviation.frequency_Hz, 2);
    damping_variance[i] = std::pow(of.deviation.damping_ratio, 2);
  }
  const auto spread = [&](const Eigen::ArrayXd& x) { return std::sqrt((x - x.mean()).square().sum() / (n - 1.0)); };
  EXPECT_NEAR(std::sqrt(frequency_variance.mean()) / spread(frequency), 1.0, 0.28);
  EXPECT_NEAR(std::sqrt(damping_variance.mean()) / spread(damping), 1.0, 0.28);
}

// A gain multiplies the correlations and their changes: modes and deviations do not notice.
TEST(CovarianceChanges, AGainChangesNoDeviation) {
  const OfRecord one = first_mode_of_record(3, 1.0), many = first_mode_of_record(3, 1000.0);
  EXPECT_NEAR(many.deviation.frequency_Hz / one.deviation.frequency_Hz, 1.0, 1e-7);
  EXPECT_NEAR(many.deviation.damping_ratio / one.deviation.damping_ratio, 1.0, 1e-7);
  EXPECT_LT((many.deviation.shape_real - one.deviation.shape_real).norm(), 1e-7 * one.deviation.shape_real.norm());
}

}  // namespace
}  // namespace twindeck::identification
