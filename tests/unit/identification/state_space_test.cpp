// Oracles: a discrete system that is built from chosen frequencies, damping ratios and shapes; a change of basis changes
// nothing.
#include "identification/state_space.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "../signal/noise.hpp"
#include "core/error.hpp"

namespace twindeck::identification {
namespace {

using Complex = std::complex<double>;

constexpr double kModelRate_Hz = 20.0;

struct ChosenMode {
  double frequency_Hz, damping_ratio;
  Eigen::Vector3cd shape;
};

/// lambda = omega (-zeta + i sqrt(1 - zeta²)).
std::complex<double> continuous(const ChosenMode& mode) {
  const double omega = 2.0 * std::numbers::pi * mode.frequency_Hz, zeta = mode.damping_ratio;
  return {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
}

const std::vector<ChosenMode> kChosen = {{5.0, 0.03, Eigen::Vector3cd(1.0, Complex(-0.8, 0.1), 0.3)},
                                         {0.7, 0.01, Eigen::Vector3cd(0.2, 0.5, Complex(1.0, -0.2))}};

/// O = [C; C A; …] of the modes in a real basis (real and imaginary part of each mode), and of a real state that decays by
/// `real_mu` a sample if that is not zero.
Eigen::MatrixXd observability_of(const std::vector<ChosenMode>& modes, int block_rows, double real_mu = 0.0) {
  const auto n = static_cast<Eigen::Index>(2 * modes.size()) + (real_mu != 0.0 ? 1 : 0);
  Eigen::MatrixXd o(3 * block_rows, n);
  for (int k = 0; k < block_rows; ++k) {
    for (std::size_t m = 0; m < modes.size(); ++m) {
      const Eigen::Vector3cd part = modes[m].shape * std::exp(continuous(modes[m]) * (k / kModelRate_Hz));
      o.block<3, 1>(3 * k, 2 * static_cast<Eigen::Index>(m)) = part.real();
      o.block<3, 1>(3 * k, 2 * static_cast<Eigen::Index>(m) + 1) = part.imag();
    }
    if (real_mu != 0.0) o.block<3, 1>(3 * k, n - 1) = Eigen::Vector3d(1.0, 0.5, -0.5) * std::pow(real_mu, k);
  }
  return o;
}

/// Any matrix as an observability matrix: singular values of one.
Observability as_observability(const Eigen::MatrixXd& o) { return {o, Eigen::VectorXd::Ones(o.cols()), {}, 3}; }

void expect_chosen(const Pole& pole, const ChosenMode& mode) {
  // The tolerances are rounding: 1e-16 times the condition of the observability matrix, some hundred.
  EXPECT_NEAR(pole.frequency_Hz, mode.frequency_Hz, 1e-11);
  EXPECT_NEAR(pole.damping_ratio, mode.damping_ratio, 1e-12);
  EXPECT_LT(std::abs(pole.eigenvalue - continuous(mode)), 1e-10);
  EXPECT_NEAR(pole.shape.norm(), 1.0, 1e-14);
  EXPECT_NEAR(std::norm(pole.shape.dot(mode.shape)) / mode.shape.squaredNorm(), 1.0, 1e-12);
}

TEST(ShiftModels, GiveTheModesThatTheSystemWasBuiltFrom) {
  const auto poles = poles_of_orders(as_observability(observability_of(kChosen, 10)), {4}, kModelRate_Hz);
  ASSERT_EQ(poles.size(), 1U);
  ASSERT_EQ(poles[0].size(), 2U);
  expect_chosen(poles[0][0], kChosen[1]);  // ascending in frequency
  expect_chosen(poles[0][1], kChosen[0]);
  EXPECT_EQ(poles[0][0].order, 4);
}

// O T has the poles and shapes of O for any regular T.
TEST(ShiftModels, ABasisOfTheStateDoesNotMatter) {
  signal::test::Noise noise(11);
  Eigen::Matrix4d t;
  for (double& x : t.reshaped()) x = noise();
  const auto poles = poles_of_orders(as_observability(observability_of(kChosen, 10) * t), {4}, kModelRate_Hz);
  ASSERT_EQ(poles[0].size(), 2U);
  expect_chosen(poles[0][0], kChosen[1]);
  expect_chosen(poles[0][1], kChosen[0]);
}

// The matrix is U S^(1/2): columns divided by roots that the singular values hold are the same matrix.
TEST(ShiftModels, SingularValuesScaleTheColumnsByTheirRoots) {
  const Eigen::Vector4d values(16.0, 9.0, 4.0, 0.25);
  const Eigen::MatrixXd o = observability_of(kChosen, 10);
  Observability scaled = as_observability(o * values.cwiseSqrt().cwiseInverse().asDiagonal());
  scaled.singular_values = values;
  EXPECT_LT((scaled.matrix() - o).norm(), 1e-14 * o.norm());
  const ShiftModels models = shift_models(scaled, {4}, kModelRate_Hz),
                    direct = shift_models(as_observability(o), {4}, kModelRate_Hz);
  EXPECT_LT((models.orders[0].a - direct.orders[0].a).norm(), 1e-12);
  EXPECT_LT((models.orders[0].c - o.topRows(3)).norm(), 1e-14);
}

TEST(ShiftModels, ARealPoleIsLeftOut) {
  for (const double mu : {0.6, -0.6}) {
    const ShiftModels models = shift_models(as_observability(observability_of(kChosen, 10, mu)), {5}, kModelRate_Hz);
    EXPECT_EQ(models.orders[0].mu.size(), 5);
    ASSERT_EQ(models.orders[0].poles.size(), 2U);
    expect_chosen(models.orders[0].poles[0], kChosen[1]);
  }
}

// A growing motion has a negative damping ratio; it is not hidden here.
TEST(ShiftModels, AGrowingMotionHasNegativeDamping) {
  const ChosenMode growing = {2.0, -0.02, Eigen::Vector3cd(1.0, 0.5, -0.2)};
  const auto poles = poles_of_orders(as_observability(observability_of({growing}, 8)), {2}, kModelRate_Hz);
  ASSERT_EQ(poles[0].size(), 1U);
  expect_chosen(poles[0][0], growing);
}

// Every order by one QR is the least-squares solution of that order alone. Oracle: Eigen's complete orthogonal decomposition.
TEST(ShiftModels, EachOrderIsTheLeastSquaresSolutionOfItsOwn) {
  signal::test::Noise noise(12);
  Eigen::MatrixXd o(30, 8);
  for (double& x : o.reshaped()) x = noise();
  const ShiftModels models = shift_models(as_observability(o), {2, 5, 8}, kModelRate_Hz);
  ASSERT_EQ(models.orders.size(), 3U);
  for (const OrderModel& model : models.orders) {
    const Eigen::MatrixXd up = o.topLeftCorner(27, model.order), down = o.bottomRows(27).leftCols(model.order);
    const Eigen::MatrixXd expected = up.completeOrthogonalDecomposition().solve(down);
    EXPECT_LT((model.a - expected).norm(), 1e-12 * expected.norm()) << model.order;
    const Eigen::MatrixXcd again = model.right * model.mu.asDiagonal() * model.left;
    EXPECT_LT((again - model.a.cast<std::complex<double>>()).norm(), 1e-11 * expected.norm());
    ASSERT_EQ(model.kept.size(), model.poles.size());
    for (std::size_t i = 0; i < model.kept.size(); ++i) {
      EXPECT_GT(model.mu[model.kept[i]].imag(), 0.0);
      EXPECT_LT(std::abs(std::exp(model.poles[i].eigenvalue / kModelRate_Hz) - model.mu[model.kept[i]]), 1e-13);
      EXPECT_GE(model.poles[i].frequency_Hz, model.poles[i > 0 ? i - 1 : 0].frequency_Hz);
    }
  }
  EXPECT_LT((models.q * models.r - o.topRows(27)).norm(), 1e-13 * o.norm());
  EXPECT_LT((models.rotated - models.q.transpose() * o.bottomRows(27)).norm(), 1e-13 * o.norm());
  EXPECT_LT((models.cross - o.bottomRows(27).transpose() * o.topRows(27)).norm(), 1e-12 * o.squaredNorm());
}

TEST(ShiftModels, NoOrdersGiveNoModelsAndAnOrderBeyondTheMatrixIsOurMistake) {
  const Observability o = as_observability(observability_of(kChosen, 10));
  EXPECT_TRUE(shift_models(o, {}, kModelRate_Hz).orders.empty());
  EXPECT_THROW(static_cast<void>(shift_models(o, {5}, kModelRate_Hz)), InternalError);
  // Two block rows give three equations, one a row: too few for four states.
  EXPECT_THROW(static_cast<void>(shift_models(as_observability(observability_of(kChosen, 2)), {4}, kModelRate_Hz)),
               InternalError);
}

// Any complex factor gives one normalised shape: unit norm, sum of squares real and positive, largest entry positive.
TEST(NormalisedShape, AnyComplexFactorGivesOneShape) {
  const Eigen::Vector3cd shape(Complex(1.0, 0.2), Complex(-2.0, 0.3), Complex(0.1, 0.4));
  const Eigen::VectorXcd once = normalised_shape(shape);
  const std::complex<double> squares = (once.transpose() * once).value();
  EXPECT_NEAR(once.norm(), 1.0, 1e-15);
  EXPECT_NEAR(squares.imag(), 0.0, 1e-15);
  EXPECT_GT(squares.real(), 0.0);
  EXPECT_GT(once[1].real(), 0.0);
  EXPECT_NEAR(std::norm(once.dot(shape)) / shape.squaredNorm(), 1.0, 1e-14);
  for (const double phase : {0.4, 1.6, 3.0, -2.0, -0.9})
    EXPECT_LT((normalised_shape(shape * std::polar(3.0, phase)) - once).norm(), 1e-14) << phase;
}

TEST(NormalisedShape, ARealShapeKeepsItsValuesAndZeroStaysZero) {
  const Eigen::Vector3cd real(-3.0, 0.0, 4.0), turned(3.0, 0.0, -4.0);
  EXPECT_LT((normalised_shape(real) - real / 5.0).norm(), 1e-15);
  EXPECT_LT((normalised_shape(turned) - real / 5.0).norm(), 1e-15);
  EXPECT_EQ(normalised_shape(Eigen::Vector3cd::Zero()).norm(), 0.0);
}

// (1, i) has no sum of squares: any phase is as good, but the norm is one and nothing is NaN.
TEST(NormalisedShape, ACircularShapeStaysFinite) {
  const Eigen::VectorXcd shape = normalised_shape(Eigen::Vector2cd(Complex(1.0, 0.0), Complex(0.0, 1.0)));
  EXPECT_TRUE(shape.allFinite());
  EXPECT_NEAR(shape.norm(), 1.0, 1e-15);
}

}  // namespace
}  // namespace twindeck::identification
