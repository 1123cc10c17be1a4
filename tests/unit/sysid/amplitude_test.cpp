// Oracles: a decay of constant frequency and damping at every level; one whose frequency and damping depend on its amplitude by
// a known law.
#include "sysid/amplitude.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::sysid {
namespace {

constexpr double kRate = 50.0, kFrequency = 1.2;

/// q'' = ... integrated as amplitude and phase: dA/dt = -zeta(A) w(A) A, d theta/dt = w(A).
template <typename Omega, typename Zeta>
Eigen::MatrixXd decay(Omega omega, Zeta zeta, double seconds, double noise) {
  test::Noise random(3);
  const auto n = static_cast<Eigen::Index>(seconds * kRate);
  Eigen::MatrixXd y(n, 2);
  double amplitude = 1.0, phase = 0.0;
  const int fine = 20;
  for (Eigen::Index t = 0; t < n; ++t) {
    y(t, 0) = amplitude * std::cos(phase) + noise * random();
    y(t, 1) = -0.5 * amplitude * std::cos(phase) + noise * random();
    for (int k = 0; k < fine; ++k) {
      const double w = omega(amplitude), z = zeta(amplitude), dt = 1.0 / (kRate * fine);
      phase += w * std::sqrt(1.0 - z * z) * dt;
      amplitude *= std::exp(-z * w * dt);
    }
  }
  return y;
}

Eigen::VectorXcd shape() {
  Eigen::VectorXcd s(2);
  s << 1.0, -0.5;
  return s;
}

TEST(DecayByAmplitude, ALinearDecayIsTheSameAtEveryLevel) {
  const double w = 2.0 * std::numbers::pi * kFrequency, zeta = 0.01;
  const auto y = decay([w](double) { return w; }, [zeta](double) { return zeta; }, 60.0, 1e-3);
  const auto points = decay_by_amplitude(modal_coordinate(y, kRate, shape(), kFrequency, 0.3), kRate, 1.0 / 0.3, 4, 1e-3);
  ASSERT_GE(points.size(), 3U);
  for (const AmplitudePoint& point : points) {
    EXPECT_NEAR(point.frequency_Hz, kFrequency, std::max(4.0 * point.frequency_std_Hz, 2e-3 * kFrequency));
    EXPECT_NEAR(point.damping_ratio, zeta, std::max(4.0 * point.damping_ratio_std, 0.05 * zeta));
  }
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT(points[i].amplitude, points[i - 1].amplitude);
}

TEST(DecayByAmplitude, FollowsAKnownLaw) {
  // Softens and damps more as it swings wider, as a friction damper that starts to slide.
  const auto omega = [](double a) { return 2.0 * std::numbers::pi * kFrequency * (1.0 - 0.05 * a); };
  const auto zeta = [](double a) { return 0.006 + 0.01 * a; };
  const auto y = decay(omega, zeta, 90.0, 1e-3);
  const auto points = decay_by_amplitude(modal_coordinate(y, kRate, shape(), kFrequency, 0.3), kRate, 1.0 / 0.3, 5, 1e-3);
  ASSERT_GE(points.size(), 4U);
  for (const AmplitudePoint& point : points) {
    EXPECT_NEAR(2.0 * std::numbers::pi * point.frequency_Hz / omega(point.amplitude), 1.0, 0.003);
    EXPECT_NEAR(point.damping_ratio / zeta(point.amplitude), 1.0, 0.10);
  }
  EXPECT_LT(points.front().frequency_Hz, points.back().frequency_Hz);
  EXPECT_GT(points.front().damping_ratio, points.back().damping_ratio);
}

}  // namespace
}  // namespace twindeck::sysid
