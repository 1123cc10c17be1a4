// A damper that slips above a threshold, and the modes of a structure with it. Oracles: closed forms of the slip and of one
// oscillator; the characteristic equation of two modes; limits of no and of free slip; scaling.
#include "transient/sliding_damper.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::transient {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ComplexNumber = std::complex<double>;

constexpr double kCircle = 2.0 * std::numbers::pi;

VectorXd alone(double value) { return VectorXd::Constant(1, value); }

TEST(SlidingDamperSlip, BeginsAtTheThreshold) {
  const SlidingDamper damper{1.0, 0.0, 4.0, 10.0};
  EXPECT_EQ(damper.slip_rate(10.0), 0.0);
  EXPECT_EQ(damper.slip_rate(-9.0), 0.0);
  EXPECT_DOUBLE_EQ(damper.slip_rate(12.0), 0.5);  // (12 - 10) / 4
  EXPECT_DOUBLE_EQ(damper.slip_rate(-12.0), -0.5);
}

// Limits: 0 without force or slip, 1/c without friction. Scaling: s depends on F / F_c alone.
TEST(EquivalentSlip, MeetsItsLimitsAndScales) {
  const VectorXd force = (VectorXd(4) << 3.0, -5.0, 0.0, 8.0).finished();
  EXPECT_NEAR(equivalent_slip({1.0, 0.0, 4.0, 0.0}, force), 0.25, 1e-15);
  EXPECT_EQ(equivalent_slip({1.0, 0.0, 4.0, 9.0}, force), 0.0);
  EXPECT_EQ(equivalent_slip({1.0, 0.0, 4.0, 1.0}, VectorXd::Zero(5)), 0.0);
  EXPECT_EQ(equivalent_slip({1.0, 0.0, 4.0, 1.0}, VectorXd()), 0.0);
  EXPECT_NEAR(equivalent_slip({1.0, 0.0, 4.0, 2.0}, force), equivalent_slip({1.0, 0.0, 4.0, 20.0}, 10.0 * force), 1e-15);
}

// Without dampers the modes are those given, in ascending order of frequency.
TEST(LinearisedModesWithoutDampers, AreTheGivenOnes) {
  const VectorXd omega = Eigen::Vector2d(9.0, 4.0), zeta = Eigen::Vector2d(0.02, 0.05);
  const LinearisedModes modes = linearised_modes(omega, zeta, MatrixXd(0, 2), {}, VectorXd(0), 100.0);
  ASSERT_EQ(modes.frequency_Hz.size(), 2);
  EXPECT_NEAR(modes.frequency_Hz(0), 4.0 / kCircle, 1e-12);
  EXPECT_NEAR(modes.damping_ratio(0), 0.05, 1e-12);
  EXPECT_NEAR(modes.frequency_Hz(1), 9.0 / kCircle, 1e-12);
  EXPECT_NEAR(modes.damping_ratio(1), 0.02, 1e-12);
  EXPECT_NEAR(std::abs(modes.shapes(1, 0)), modes.shapes.col(0).norm(), 1e-12);
  EXPECT_GT(modes.shapes(1, 0).real(), 0.0);
}

TEST(LinearisedModesWithoutDampers, EndAtTheHighestFrequency) {
  const VectorXd omega = Eigen::Vector2d(kCircle * 1.0, kCircle * 3.0), zeta = VectorXd::Zero(2);
  EXPECT_EQ(linearised_modes(omega, zeta, MatrixXd(0, 2), {}, VectorXd(0), 2.0).frequency_Hz.size(), 1);
  // A damping above 1 leaves no oscillation.
  EXPECT_EQ(linearised_modes(omega, Eigen::Vector2d(1.5, 0.0), MatrixXd(0, 2), {}, VectorXd(0), 9.0).frequency_Hz.size(), 1);
}

// A mount with damping that does not slip: omega² + k b² and 2 zeta omega + c_m b² of one oscillator.
TEST(LinearisedModes, OfAStuckDamperHaveItsMount) {
  const double omega = 6.0, zeta = 0.01, b = 0.5, k = 40.0, c = 0.8;
  const LinearisedModes modes =
      linearised_modes(alone(omega), alone(zeta), MatrixXd::Constant(1, 1, b), {{k, c, 5.0, 1.0}}, alone(0.0), 100.0);
  ASSERT_EQ(modes.frequency_Hz.size(), 1);
  const double stiff = std::sqrt(omega * omega + k * b * b);
  EXPECT_NEAR(modes.frequency_Hz(0), stiff / kCircle, 1e-12);
  EXPECT_NEAR(modes.damping_ratio(0), (2.0 * zeta * omega + c * b * b) / (2.0 * stiff), 1e-12);
}

// Dynamic stiffness of mount and slip in series, from F = (k + c_m λ)(u - x), λ x = s F:
//   Z(λ) = (k + c_m λ) λ / (λ + s (k + c_m λ)).
// Each λ and its shape then obey (λ² + 2 ζ ω λ + ω²) q + sum of b_j Z_j b_j' q = 0. Two modes, two unlike dampers.
TEST(LinearisedModes, ObeyTheDynamicStiffnessOfTheDampers) {
  const VectorXd omega = Eigen::Vector2d(6.0, 11.0), zeta = Eigen::Vector2d(0.01, 0.02), slip = Eigen::Vector2d(0.05, 0.3);
  const MatrixXd b = (MatrixXd(2, 2) << 0.5, 0.9, -0.7, 0.4).finished();
  const std::vector<SlidingDamper> dampers = {{40.0, 0.8, 5.0, 1.0}, {25.0, 0.3, 2.0, 1.0}};
  const LinearisedModes modes = linearised_modes(omega, zeta, b, dampers, slip, 100.0);
  ASSERT_EQ(modes.frequency_Hz.size(), 2);
  EXPECT_LT(modes.frequency_Hz(0), modes.frequency_Hz(1));
  for (int i = 0; i < 2; ++i) {
    const double size = kCircle * modes.frequency_Hz(i), damping = modes.damping_ratio(i);
    EXPECT_GT(damping, 0.0);
    const ComplexNumber lambda(-damping * size, size * std::sqrt(1.0 - damping * damping));
    Eigen::Matrix2cd dynamic = Eigen::Matrix2cd::Zero();
    for (int r = 0; r < 2; ++r) dynamic(r, r) = lambda * lambda + 2.0 * zeta(r) * omega(r) * lambda + omega(r) * omega(r);
    for (int j = 0; j < 2; ++j) {
      const SlidingDamper& damper = dampers[static_cast<std::size_t>(j)];
      const ComplexNumber mount = damper.stiffness_N_m + damper.mount_damping_N_s_m * lambda;
      dynamic += mount * lambda / (lambda + slip(j) * mount) * (b.row(j).transpose() * b.row(j)).cast<ComplexNumber>();
    }
    const Eigen::Vector2cd shape = modes.shapes.col(i);
    EXPECT_LT((dynamic * shape).norm(), 1e-10 * size * size * shape.norm()) << i;
    // The leading entry is real and positive.
    Eigen::Index leading = 0;
    shape.cwiseAbs().maxCoeff(&leading);
    EXPECT_NEAR(shape(leading).imag(), 0.0, 1e-14);
    EXPECT_GT(shape(leading).real(), 0.0);
  }
}

// Limit of free slip: no force is left, and the structure is as without the damper.
TEST(LinearisedModes, OfADamperThatSlipsFreelyAreThoseWithout) {
  const LinearisedModes modes =
      linearised_modes(alone(6.0), alone(0.03), MatrixXd::Ones(1, 1), {{40.0, 0.8, 1.0, 0.0}}, alone(1e9), 100.0);
  ASSERT_EQ(modes.frequency_Hz.size(), 1);
  EXPECT_NEAR(modes.frequency_Hz(0), 6.0 / kCircle, 1e-8);  // the dashpot left has 1e-9 N s/m
  EXPECT_NEAR(modes.damping_ratio(0), 0.03, 1e-8);
}

TEST(LinearisedModes, RefuseSizesThatDoNotFit) {
  EXPECT_THROW((void)linearised_modes(alone(6.0), alone(0.0), MatrixXd::Ones(2, 1), {{40.0, 0.0, 1.0, 0.0}}, alone(0.0), 9.0),
               InternalError);
}

}  // namespace
}  // namespace twindeck::transient
