#include "transient/trapezoidal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twindeck::transient {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd one(double value) { return VectorXd::Constant(1, value); }

// Oracle: the trapezoidal rule turns a free oscillation of omega into one of 2/dt atan(omega dt/2) exactly, without damping.
TEST(TrapezoidalStepper, FreeOscillationHasTheDiscreteFrequencyAndKeepsItsAmplitude) {
  const double omega = 11.0, dt = 0.02;
  TrapezoidalStepper stepper(one(omega), one(0.0), dt);
  stepper.start(one(1.0), one(omega * omega));
  // The load that held it is let go at once: one step under half of it, in the mean, is what the rule makes of that.
  stepper.step(one(0.0));
  const double q0 = stepper.displacement()[0], v0 = stepper.velocity()[0], discrete = 2.0 / dt * std::atan(0.5 * omega * dt);
  const double energy = v0 * v0 + omega * omega * q0 * q0;
  for (int n = 1; n <= 5000; ++n) {
    stepper.step(one(0.0));
    const double q = stepper.displacement()[0], v = stepper.velocity()[0], t = n * dt;
    ASSERT_NEAR(v * v + omega * omega * q * q, energy, 1e-9 * energy);
    ASSERT_NEAR(q, q0 * std::cos(discrete * t) + v0 / omega * std::sin(discrete * t), 1e-9);
  }
}

// Oracle: closed form of the response to a constant load, q = p/omega² once the damping has eaten the oscillation.
TEST(TrapezoidalStepper, SettlesAtTheStaticDisplacement) {
  TrapezoidalStepper stepper(one(20.0), one(0.1), 0.01);
  for (int n = 0; n < 2000; ++n) stepper.step(one(8.0));
  EXPECT_NEAR(stepper.displacement()[0], 8.0 / 400.0, 1e-12);
}

// Oracle: below its threshold a damper is its mount, so that the oscillator of K + k B'B must come out, to the step's own error
// in phase: both are stepped by the same rule.
TEST(TrapezoidalStepper, StuckDamperIsASpring) {
  const double omega = 6.0, k = 25.0, b = 0.7;
  const SlidingDamper damper{k, 0.0, 3.0, 1e9};
  TrapezoidalStepper with(one(omega), one(0.0), 0.005), spring(one(std::sqrt(omega * omega + k * b * b)), one(0.0), 0.005);
  with.set_dampers(MatrixXd::Constant(1, 1, b), {damper});
  for (int n = 0; n < 4000; ++n) {
    const VectorXd load = one(std::sin(0.03 * n) + (n < 5 ? 40.0 : 0.0));
    with.step(load);
    spring.step(load);
    ASSERT_NEAR(with.displacement()[0], spring.displacement()[0], 1e-9);
  }
}

// Oracle: energy. Work of the load on a Maxwell element without friction is kinetic + strain energy + what the dashpot ate,
// F²/c.
TEST(TrapezoidalStepper, EnergyIsAccountedFor) {
  const double omega = 5.0, dt = 2e-4;
  const SlidingDamper damper{30.0, 0.0, 4.0, 0.3};
  TrapezoidalStepper stepper(one(omega), one(0.0), dt);
  stepper.set_dampers(MatrixXd::Constant(1, 1, 1.0), {damper});
  double work = 0.0, eaten = 0.0, largest = 0.0;
  double q = 0.0, load_before = 0.0;
  for (int n = 1; n <= 60000; ++n) {
    const double load = 2.0 * std::sin(4.0 * n * dt);
    stepper.step(one(load));
    const double force = stepper.damper_force()[0];
    work += 0.5 * (load + load_before) * (stepper.displacement()[0] - q);
    eaten += std::abs(force * damper.slip_rate(force)) * dt;
    q = stepper.displacement()[0];
    load_before = load;
    const double v = stepper.velocity()[0], stored = 0.5 * (v * v + omega * omega * q * q + force * force / 30.0);
    largest = std::max(largest, stored);
    ASSERT_NEAR(work, stored + eaten, 2e-3 * (largest + eaten));
  }
  EXPECT_GT(eaten, largest);
}

// Oracle: equation of the element itself, F = k (u - x), x' = g(F), integrated beside the stepper from its own u; and of
// several dampers at once none may be out of balance.
TEST(TrapezoidalStepper, ForcesObeyTheElementsLaw) {
  const double dt = 0.005;
  const VectorXd omega = (VectorXd(3) << 4.0, 9.0, 40.0).finished();
  MatrixXd b(2, 3);
  b << 0.5, -0.3, 0.8, 0.2, 0.6, -0.7;
  const std::vector<SlidingDamper> dampers = {{50.0, 0.4, 5.0, 1.0}, {20.0, 0.0, 2.0, 0.4}};
  TrapezoidalStepper stepper(omega, VectorXd::Constant(3, 0.01), dt);
  stepper.set_dampers(b, dampers);
  VectorXd slip = VectorXd::Zero(2);
  int sliding = 0;
  for (int n = 1; n <= 4000; ++n) {
    const double t = n * dt;
    stepper.step((VectorXd(3) << 3.0 * std::sin(4.2 * t), 2.0 * std::cos(8.5 * t), 5.0 * std::sin(1.3 * t)).finished());
    const VectorXd u = b * stepper.displacement(), v = b * stepper.velocity();
    for (Eigen::Index j = 0; j < 2; ++j) {
      const SlidingDamper& d = dampers[static_cast<std::size_t>(j)];
      const double force = stepper.damper_force()[j], rate = d.slip_rate(force);
      slip[j] += dt * rate;
      sliding += rate != 0.0;
      ASSERT_NEAR(force, d.stiffness_N_m * (u[j] - slip[j]) + d.mount_damping_N_s_m * (v[j] - rate), 1e-8);
    }
  }
  EXPECT_GT(sliding, 500);
  EXPECT_LT(sliding, 7500);
}

// Oracle: closed form of E[F g(F)]/E[F²] for Gaussian forces, erfc(a/sqrt 2)/c with a = F_c/sigma (integration by parts), from
// a lattice of quantiles.
TEST(SlidingDamper, EquivalentSlipOfAGaussianForce) {
  const SlidingDamper damper{1.0, 0.0, 3.0, 1.2};
  const int n = 200001;
  VectorXd force(n), weight(n);
  double numerator = 0.0, denominator = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = -8.0 + 16.0 * i / (n - 1);
    const double w = std::exp(-0.5 * x * x);
    numerator += w * x * damper.slip_rate(x);
    denominator += w * x * x;
  }
  EXPECT_NEAR(numerator / denominator, std::erfc(1.2 / std::numbers::sqrt2) / 3.0, 1e-6);
  EXPECT_NEAR(equivalent_slip(damper, (VectorXd(3) << 2.2, -2.2, 0.5).finished()),
              (2 * 2.2 * 1.0 / 3.0) / (2 * 2.2 * 2.2 + 0.25), 1e-15);
  EXPECT_EQ(equivalent_slip(damper, VectorXd::Constant(4, 1.1)), 0.0);
}

// Oracles: a stuck damper is a spring (frequency of K + k b²); one that slides freely, Maxwell's complex stiffness k i c w/(k +
// i c w) in lambda² + omega² + b² k c lambda/(k + c lambda) = 0.
TEST(LinearisedModes, SpringAndMaxwell) {
  const VectorXd omega = one(6.0), zeta = one(0.0);
  const MatrixXd b = MatrixXd::Constant(1, 1, 0.5);
  const std::vector<SlidingDamper> damper = {{40.0, 0.0, 5.0, 1.0}};
  const LinearisedModes stuck = linearised_modes(omega, zeta, b, damper, one(0.0), 100.0);
  ASSERT_EQ(stuck.frequency_Hz.size(), 1);
  EXPECT_NEAR(stuck.frequency_Hz[0], std::sqrt(46.0) / (2.0 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(stuck.damping_ratio[0], 0.0, 1e-12);
  const LinearisedModes slides = linearised_modes(omega, zeta, b, damper, one(1.0 / 5.0), 100.0);
  ASSERT_EQ(slides.frequency_Hz.size(), 1);
  const double w = 2.0 * std::numbers::pi * slides.frequency_Hz[0], z = slides.damping_ratio[0];
  const std::complex<double> lambda(-z * w, w * std::sqrt(1.0 - z * z));
  EXPECT_NEAR(std::abs(lambda * lambda + 36.0 + 0.25 * 40.0 * 5.0 * lambda / (40.0 + 5.0 * lambda)), 0.0, 1e-10);
}

}  // namespace
}  // namespace twindeck::transient
