// Oracles: a decay of constant frequency and damping at every level; one whose frequency and damping depend on its amplitude by
// a known law.
#include "identification/amplitude.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::identification {
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
  const auto points =
      decay_by_amplitude(decaying_coordinate(y, kRate, shape(), kFrequency, zeta, 0.3).value, kRate, 1.0 / 0.3, 4, 1e-3);
  ASSERT_GE(points.size(), 3U);
  for (const AmplitudePoint& point : points) {
    EXPECT_NEAR(point.frequency_Hz, kFrequency, std::max(4.0 * point.frequency_std_Hz, 2e-3 * kFrequency));
    EXPECT_NEAR(point.damping_ratio, zeta, std::max(4.0 * point.damping_ratio_std, 0.05 * zeta));
  }
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT(points[i].amplitude, points[i - 1].amplitude);
}

// The whole record holds six times the memory of the filter. What is known of the mode is a tenth off in damping and a
// thousandth in frequency; another mode decays beside it.
TEST(DecayingCoordinate, DoesNotRingAtTheEndsOfAShortRecord) {
  const double w = 2.0 * std::numbers::pi * kFrequency, zeta = 0.01, band = 0.1;
  auto y = decay([w](double) { return w; }, [zeta](double) { return zeta; }, 50.0, 0.0);
  for (Eigen::Index t = 0; t < y.rows(); ++t) {
    const double s = static_cast<double>(t) / kRate;
    y.row(t).array() += 0.5 * std::exp(-0.01 * 1.7 * w * s) * std::cos(1.7 * w * s);
  }
  const DecayingCoordinate q = decaying_coordinate(y, kRate, shape(), 1.001 * kFrequency, 0.9 * zeta, band);
  ASSERT_EQ(q.value.size(), y.rows());
  // Beyond one memory from the ends; what is left there is the other mode's turn in the filter's flank.
  const auto memory = static_cast<Eigen::Index>(0.5 / band * kRate);
  for (Eigen::Index t = memory; t < y.rows() - memory; t += 50) {
    const double amplitude = std::exp(-zeta * w * static_cast<double>(t) / kRate);
    EXPECT_NEAR(std::abs(q.value[t]) / amplitude, 1.0, 0.02) << t;
  }
  const auto points = decay_by_amplitude(q.value, kRate, 0.5 / band, 4, q.noise);
  ASSERT_EQ(points.size(), 4U);
  for (const AmplitudePoint& point : points) {
    EXPECT_NEAR(point.damping_ratio, zeta, 0.03 * zeta);
    EXPECT_NEAR(point.frequency_Hz, kFrequency, 1e-4 * kFrequency);
  }
}

// A decay to e^-38 in the record: where it has met the noise of 1e-3 it is not magnified further.
TEST(DecayingCoordinate, EndsWhereTheDecayMeetsTheNoise) {
  const double w = 2.0 * std::numbers::pi * kFrequency, zeta = 0.05;
  const auto y = decay([w](double) { return w; }, [zeta](double) { return zeta; }, 100.0, 1e-3);
  const DecayingCoordinate q = decaying_coordinate(y, kRate, shape(), kFrequency, zeta, 0.3);
  const double seconds = static_cast<double>(q.value.size()) / kRate;
  EXPECT_GT(seconds, std::log(1e3) / (zeta * w));
  EXPECT_LT(seconds, std::log(1e5) / (zeta * w));
  for (const AmplitudePoint& point : decay_by_amplitude(q.value, kRate, 0.5 / 0.3, 4, q.noise))
    EXPECT_NEAR(point.damping_ratio, zeta, std::max(4.0 * point.damping_ratio_std, 0.05 * zeta));
}

// White noise without memory on few samples, so that it matters how many residuals are left when a line is fitted: the stated
// variances are on average what the values scatter by, within what 3,000 draws tell (1.3 % of a deviation; a count without the
// line's two is a tenth off).
TEST(DecayByAmplitude, StatedDeviationsAreWhatValuesOfAShortBandScatterBy) {
  constexpr int kDraws = 3000;
  constexpr Eigen::Index kSamples = 12;
  constexpr double kNoise = 1e-4, kOmega = 2.0 * std::numbers::pi * kFrequency, kDecay = 0.01;
  test::Noise random(17);
  Eigen::ArrayXd frequency(kDraws), damping(kDraws);
  double stated_frequency = 0.0, stated_damping = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXcd coordinate(kSamples);
    for (Eigen::Index t = 0; t < kSamples; ++t)
      coordinate[t] = std::exp(std::complex<double>(-kDecay * static_cast<double>(t) + kNoise * random(),
                                                    kOmega * static_cast<double>(t) / kRate + kNoise * random()));
    const auto points = decay_by_amplitude(coordinate, kRate, 1.0 / kRate, 1, 0.0);
    ASSERT_EQ(points.size(), 1U);
    frequency[draw] = points[0].frequency_Hz;
    damping[draw] = points[0].damping_ratio;
    stated_frequency += std::pow(points[0].frequency_std_Hz, 2) / kDraws;
    stated_damping += std::pow(points[0].damping_ratio_std, 2) / kDraws;
  }
  const auto scatter = [](const Eigen::ArrayXd& x) { return std::sqrt((x - x.mean()).square().mean()); };
  EXPECT_NEAR(std::sqrt(stated_frequency) / scatter(frequency), 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(stated_damping) / scatter(damping), 1.0, 0.05);
}

TEST(DecayByAmplitude, FollowsAKnownLaw) {
  // Softens and damps more as it swings wider, as a friction damper that starts to slide.
  const auto omega = [](double a) { return 2.0 * std::numbers::pi * kFrequency * (1.0 - 0.05 * a); };
  const auto zeta = [](double a) { return 0.006 + 0.01 * a; };
  const auto y = decay(omega, zeta, 90.0, 1e-3);
  const auto points =
      decay_by_amplitude(decaying_coordinate(y, kRate, shape(), kFrequency, 0.01, 0.3).value, kRate, 1.0 / 0.3, 5, 1e-3);
  ASSERT_GE(points.size(), 4U);
  for (const AmplitudePoint& point : points) {
    EXPECT_NEAR(2.0 * std::numbers::pi * point.frequency_Hz / omega(point.amplitude), 1.0, 0.003);
    EXPECT_NEAR(point.damping_ratio / zeta(point.amplitude), 1.0, 0.10);
  }
  EXPECT_LT(points.front().frequency_Hz, points.back().frequency_Hz);
  EXPECT_GT(points.front().damping_ratio, points.back().damping_ratio);
}

}  // namespace
}  // namespace twindeck::identification
