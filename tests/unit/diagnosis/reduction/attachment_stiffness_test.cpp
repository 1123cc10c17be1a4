// Oracles: the first harmonic of the force of a Jenkins element that is moved to and fro; the energy of its loop; the balance
// at a slider, put in again; limits of soft and hard friction; central differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/reduction/structure_state.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Attachment;
using diagnosis::jenkins_stiffness;
using diagnosis::sliding_stiffness;
using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi, kStiff = 3e6, kThreshold = 1200.0, kYield = kThreshold / kStiff;

/// First harmonic of the force over x = X cos(t), by moving spring and slider in small steps through the second of two cycles.
Complex moved_to_and_fro(double amplitude) {
  constexpr int kSteps = 200000;
  double slider = 0.0;
  Complex sum = 0.0;
  for (int i = 0; i < 2 * kSteps; ++i) {
    const double t = 2.0 * kPi * i / kSteps, x = amplitude * std::cos(t);
    slider = std::clamp(slider, x - kYield, x + kYield);
    if (i >= kSteps) sum += kStiff * (x - slider) * std::exp(Complex(0.0, -t));
  }
  return 2.0 * sum / (kSteps * amplitude);
}

TEST(JenkinsStiffness, IsTheFirstHarmonicOfItsForce) {
  // The rectangle rule on 200,000 steps of a periodic function with kinks errs by some 1e-9; 1e-6 of k leaves room.
  for (const double times : {1.01, 1.5, 2.0, 5.0, 40.0}) {
    const Complex balance = jenkins_stiffness(kStiff, kThreshold, times * kYield);
    EXPECT_LT(std::abs(balance - moved_to_and_fro(times * kYield)), 1e-6 * kStiff) << times;
  }
}

TEST(JenkinsStiffness, LosesTheAreaOfItsLoop) {
  // The loop is a parallelogram of 4 F_c (X - X_y); a stiffness with imaginary part Im loses pi X² Im in a cycle.
  for (const double times : {1.2, 3.0, 20.0}) {
    const double x = times * kYield, lost = kPi * x * x * jenkins_stiffness(kStiff, kThreshold, x).imag();
    EXPECT_NEAR(lost / (4.0 * kThreshold * (x - kYield)), 1.0, 1e-12) << times;
  }
}

TEST(JenkinsStiffness, SticksBelowItsThreshold) {
  EXPECT_EQ(jenkins_stiffness(kStiff, kThreshold, 0.0), Complex(kStiff));
  EXPECT_EQ(jenkins_stiffness(kStiff, kThreshold, kYield), Complex(kStiff));
  // It starts to slide without a jump: just beyond, (X - X_y)/X = 1e-6 is all that the loss has.
  EXPECT_LT(std::abs(jenkins_stiffness(kStiff, kThreshold, kYield * (1.0 + 1e-6)) - kStiff), 2e-6 * kStiff);
}

TEST(SlidingStiffness, WithoutADashpotIsTheJenkinsElement) {
  for (const double times : {0.5, 1.5, 6.0})
    EXPECT_EQ(sliding_stiffness(kStiff, kThreshold, 0.0, 4.0, times * kYield),
              jenkins_stiffness(kStiff, kThreshold, times * kYield));
}

TEST(SlidingStiffness, BalancesAtTheSlider) {
  // The spring carries d X, so that the slider moves by Y = X (1 - d/k). There the force is that of the dashpot and of
  // friction, i (c omega + 4 F_c / (pi |Y|)) Y.
  constexpr double kDamping = 2e5, kOmega = 3.8;
  for (const double times : {1.4, 2.0, 10.0, 300.0}) {
    const double x = times * kYield;
    const Complex d = sliding_stiffness(kStiff, kThreshold, kDamping, kOmega, x), y = x * (1.0 - d / kStiff);
    const Complex slider = Complex(0.0, kDamping * kOmega + 4.0 * kThreshold / (kPi * std::abs(y))) * y;
    EXPECT_LT(std::abs(d * x - slider), 1e-9 * std::abs(d * x)) << times;
  }
}

TEST(SlidingStiffness, HoldsBelowTheFirstHarmonicOfItsFriction) {
  const double held = 4.0 * kThreshold / (kPi * kStiff);
  EXPECT_EQ(sliding_stiffness(kStiff, kThreshold, 2e5, 3.8, 0.999 * held), Complex(kStiff));
  EXPECT_NE(sliding_stiffness(kStiff, kThreshold, 2e5, 3.8, 1.01 * held), Complex(kStiff));
}

TEST(SlidingStiffness, OfLargeMotionIsSpringAndDashpotInSeries) {
  // Friction counts as F_c / X beside c omega: 1e-5 of it at this amplitude.
  constexpr double kDamping = 2e5, kOmega = 3.8;
  const double x = 4.0 * kThreshold / (kPi * kDamping * kOmega) * 1e5;
  const Attachment maxwell{Attachment::Kind::maxwell, {}, kStiff, kDamping, 0.0};
  const Complex series = dynamic_stiffness(maxwell, Complex(0.0, kOmega), 0.0).first;
  EXPECT_LT(std::abs(sliding_stiffness(kStiff, kThreshold, kDamping, kOmega, x) - series), 2e-5 * std::abs(series));
}

TEST(DynamicStiffness, OfADashpotAndOfASpringInSeriesAreWrittenOut) {
  const Complex s(-0.3, 4.0);
  const Attachment dashpot{Attachment::Kind::dashpot, {}, 0.0, 5e4, 0.0};
  EXPECT_LT(std::abs(dynamic_stiffness(dashpot, s, 1.0).first - 5e4 * s), 1e-9);
  // In series flexibilities add: 1/d = 1/k + 1/(c s).
  const Attachment maxwell{Attachment::Kind::maxwell, {}, 2e5, 5e4, 0.0};
  const Complex d = 1.0 / (1.0 / 2e5 + 1.0 / (5e4 * s));
  EXPECT_LT(std::abs(dynamic_stiffness(maxwell, s, 1.0).first - d), 1e-12 * std::abs(d));
}

TEST(DynamicStiffness, DerivativesAreThoseOfCentralDifferences) {
  // The error of the difference is h²/6 of the third derivative, below 1e-8 of the first at h = 1e-3.
  const Complex s(-0.3, 4.0), h(1e-3, 0.0);
  for (const Attachment& a :
       {Attachment{Attachment::Kind::dashpot, {}, 0.0, 5e4, 0.0}, Attachment{Attachment::Kind::maxwell, {}, 2e5, 5e4, 0.0}}) {
    const Complex slope = dynamic_stiffness(a, s, 1.0).second;
    const Complex difference = (dynamic_stiffness(a, s + h, 1.0).first - dynamic_stiffness(a, s - h, 1.0).first) / (2.0 * h);
    EXPECT_LT(std::abs(slope - difference), 1e-6 * std::abs(slope));
  }
}

TEST(DynamicStiffness, OfFrictionGoesByTheAmplitude) {
  const Attachment friction{Attachment::Kind::jenkins, {}, kStiff, 0.0, kThreshold};
  const auto [d, slope] = dynamic_stiffness(friction, Complex(-0.1, 4.0), 3.0 * kYield);
  EXPECT_EQ(d, jenkins_stiffness(kStiff, kThreshold, 3.0 * kYield));
  EXPECT_EQ(slope, Complex(0.0));
}

}  // namespace
}  // namespace twindeck::tests
