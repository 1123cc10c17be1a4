/// Oracles: closed form of the damped oscillator, the order of the method, conservation of energy, the complex stiffness of a
/// Maxwell unit, equivalent damping of a Coulomb oscillator, and the linear limits of friction.
#include "transient/newmark.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace twindeck::transient {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LinearSystem oscillator(double omega, double ratio) {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  return {one, 2.0 * ratio * omega * one, omega * omega * one};
}

double error_of_free_decay(double step) {
  const double omega = 2.0 * std::numbers::pi, xi = 0.02, duration = 5.0;
  const auto n = static_cast<Index>(std::llround(duration / step)) + 1;
  const History h = Newmark(oscillator(omega, xi), step).run(MatrixXd::Zero(1, n), {VectorXd::Ones(1), VectorXd::Zero(1)});
  const double damped = omega * std::sqrt(1.0 - xi * xi);
  const double exact =
      std::exp(-xi * omega * duration) * (std::cos(damped * duration) + xi * omega / damped * std::sin(damped * duration));
  return std::abs(h.displacement(0, n - 1) - exact);
}

TEST(Newmark, ConvergesToTheDampedOscillatorWithSecondOrder) {
  const double coarse = error_of_free_decay(1.0 / 256), fine = error_of_free_decay(1.0 / 512);
  EXPECT_LT(fine, 2e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
}

TEST(Newmark, KeepsTheEnergyOfAnUndampedOscillatorWhateverTheStep) {
  const double omega = 2.0 * std::numbers::pi;
  for (const double step : {0.01, 0.3, 2.0}) {
    const History h =
        Newmark(oscillator(omega, 0.0), step).run(MatrixXd::Zero(1, 2000), {VectorXd::Ones(1), VectorXd::Zero(1)});
    EXPECT_NEAR(h.displacement.row(0).tail(200).cwiseAbs().maxCoeff(), 1.0, 0.02) << step;
  }
}

TEST(Newmark, MaxwellUnitHasItsComplexStiffness) {
  // A light oscillator with a Maxwell unit, shaken harmonically: steady amplitude 1/|k0 - w² + i w k c/(k + i w c)|.
  const double k = 30.0, c = 4.0, k0 = 40.0, w = 5.0, step = 1.0 / 512;
  LinearSystem system = {MatrixXd::Identity(1, 1), MatrixXd::Constant(1, 1, 0.3), MatrixXd::Constant(1, 1, k0)};
  add_maxwell(system, VectorXd::Ones(1), k, c);
  const Index n = 40000;
  MatrixXd force(1, n);
  for (Index i = 0; i < n; ++i) force(0, i) = std::sin(w * step * static_cast<double>(i));
  const History h = Newmark(system, step).run(force);
  const std::complex<double> i(0.0, 1.0);
  const double expected = 1.0 / std::abs(k0 - w * w + i * w * 0.3 + i * w * k * c / (k + i * w * c));
  EXPECT_NEAR(h.displacement.row(0).tail(2000).maxCoeff() / expected, 1.0, 1e-4);
}

TEST(Newmark, FrictionBelowItsThresholdIsASpring) {
  // Two coupled masses; threshold never reached: the same as a spring in K, to rounding.
  LinearSystem with = {MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2) * 0.1, MatrixXd::Identity(2, 2) * 50.0};
  with.stiffness(0, 1) = with.stiffness(1, 0) = -10.0;
  LinearSystem spring = with;
  VectorXd direction(2);
  direction << 1.0, -0.5;
  spring.stiffness += 200.0 * direction * direction.transpose();
  MatrixXd force = MatrixXd::Zero(2, 500);
  for (Index i = 0; i < 500; ++i) force(0, i) = std::sin(0.05 * static_cast<double>(i));
  const History a = Newmark(with, 0.01, {{direction, 200.0, 1e6}}).run(force), b = Newmark(spring, 0.01).run(force);
  ASSERT_TRUE(a.status.converged);
  EXPECT_LT((a.acceleration - b.acceleration).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Newmark, SlippingFrictionTakesTheWorkOfCoulombsLaw) {
  // Free decay under Coulomb friction: the amplitude falls by 4 F/k a period, linearly (stick stiffness far above k).
  const double k = std::pow(2.0 * std::numbers::pi, 2), threshold = 0.01 * k, step = 1.0 / 1000;
  const History h = Newmark(oscillator(2.0 * std::numbers::pi, 0.0), step, {{VectorXd::Ones(1), 1e4 * k, threshold}})
                        .run(MatrixXd::Zero(1, 10001), {VectorXd::Ones(1), VectorXd::Zero(1)});
  ASSERT_TRUE(h.status.converged);
  EXPECT_NEAR(h.displacement.row(0).segment(9000, 1001).maxCoeff(), 1.0 - 4.0 * 0.01 * 9.0, 0.01);
  EXPECT_LE(h.friction_N.cwiseAbs().maxCoeff(), threshold * (1.0 + 1e-12));
}

TEST(Newmark, AdvancingInPiecesIsTheRun) {
  // From rest, more coordinates than a panel of the product has rows, unsymmetric matrices, a coordinate without mass. Another
  // order of the same sums: equal to rounding.
  const Index r = 21, n = 400;
  LinearSystem system = {MatrixXd::Identity(r, r), MatrixXd::Zero(r, r), MatrixXd::Zero(r, r)};
  for (Index i = 0; i < r; ++i) {
    for (Index j = 0; j < r; ++j) {
      system.damping(i, j) = (i == j ? 1.0 : 0.0) + 0.02 * std::sin(static_cast<double>(3 * i + j));
      system.stiffness(i, j) = (i == j ? 40.0 + 30.0 * static_cast<double>(i) : 0.0) + std::cos(static_cast<double>(i + 5 * j));
    }
  }
  add_maxwell(system, VectorXd::LinSpaced(r, 0.1, 1.0), 30.0, 4.0);
  const double step = 1.0 / 64;
  MatrixXd force(r, n);
  for (Index t = 0; t < n; ++t)
    for (Index i = 0; i < r; ++i) force(i, t) = std::sin(0.07 * static_cast<double>(t * (i + 1)));
  force.col(0).setZero();
  const Newmark newmark(system, step);
  const History whole = newmark.run(force);
  MatrixXd found = newmark.within_a_step(force);
  Motion motion;
  newmark.advance(motion, found.middleCols(1, 7));
  newmark.advance(motion, found.middleCols(8, 0));
  newmark.advance(motion, found.rightCols(n - 8));
  EXPECT_LT((found - whole.acceleration).norm(), 1e-11 * whole.acceleration.norm());
  EXPECT_LT((motion.displacement - whole.displacement.col(n - 1)).norm(), 1e-11 * whole.displacement.norm());
}

TEST(Newmark, RefusesASingularSystemAndABadStep) {
  const MatrixXd zero = MatrixXd::Zero(1, 1);
  EXPECT_THROW(Newmark({zero, zero, zero}, 0.1), InputError);
  EXPECT_THROW(Newmark(oscillator(1.0, 0.0), 0.0), InputError);
}

}  // namespace
}  // namespace twindeck::transient
