/// Oracles: equations of one degree of freedom by hand; the steady amplitude of a harmonic load in closed form; a periodic
/// sample gives a periodic response; linearity.
#include "buffeting/response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "known_derivatives.hpp"
#include "verification/wind_sections.hpp"

namespace twindeck::buffeting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kResponseMass = 1500.0, kResponseChord = 4.5;

/// Heave of a section with h1 and h4 of Zasso's form.
aero::AeroelasticSystem heave_with(double h1, double h4, const std::vector<aero::MaxwellUnit>& maxwell = {}) {
  aero::Derivatives18 zasso{};
  zasso[0] = h1;
  zasso[3] = h4;
  aero::ReducedStructure s = wind_test::structure({0.7}, 0.02);
  s.maxwell = maxwell;
  return wind_test::section_model(s, kResponseChord, 1.25, std::make_shared<aero::ConstantZasso>(zasso),
                                  {{0, 1 / std::sqrt(kResponseMass), 0}});
}

/// Wind of one input: a whole number of waves in the sample.
MatrixXd harmonic_wind(Index n, Index waves) {
  MatrixXd wind(n, 1);
  for (Index i = 0; i < n; ++i)
    wind(i, 0) = std::sin(2.0 * std::numbers::pi * static_cast<double>(waves * i) / static_cast<double>(n));
  return wind;
}

// q̈ + (2ξω + ρVB h1/(2m)) q̇ + (ω² - ½ρΩ²B²(π/2) h4/m) q = f, with the derivatives at Ω.
TEST(EquationsOfMotion, HaveTheWindOnTheLeft) {
  const double omega = 2 * std::numbers::pi * 0.7, V = 12.0, at = 3.0;
  const transient::LinearSystem found = equations_of_motion(heave_with(-1.5, 0.8), V, at);
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found.mass(0, 0), 1.0);
  EXPECT_NEAR(found.damping(0, 0), 2 * 0.02 * omega + 0.5 * 1.25 * V * kResponseChord * -1.5 / kResponseMass, 1e-14);
  const double added = 0.5 * 1.25 * at * at * kResponseChord * kResponseChord * std::numbers::pi / 2 * 0.8 / kResponseMass;
  EXPECT_NEAR(found.stiffness(0, 0), omega * omega - added, 1e-13);
}

// A Maxwell unit adds a point without mass: k (x - s) = c ṡ.
TEST(EquationsOfMotion, MaxwellUnitsAddTheirInnerPoint) {
  const transient::LinearSystem found =
      equations_of_motion(heave_with(0.0, 0.0, {{7.0, 3.0, VectorXd::Constant(1, 2.0)}}), 5.0, 3.0);
  ASSERT_EQ(found.size(), 2);
  const double omega = 2 * std::numbers::pi * 0.7;
  EXPECT_LT((found.stiffness - (Eigen::Matrix2d() << omega * omega + 28.0, -14.0, -14.0, 7.0).finished()).norm(), 1e-12);
  EXPECT_NEAR(found.damping(1, 1), 3.0, 1e-15);
  EXPECT_EQ(found.mass(1, 1), 0.0);
}

// Steady acceleration ω²R/|ω0² - ω² + 2iξω0ω|, of each sensor times its factor. At 64 points a wave Newmark's period errs by
// (ω dt)²/12 = 8e-4, which counts little away from resonance: 1 %. The lead-in of 100 s leaves exp(-ξω0 t) = 2e-4.
TEST(Respond, SteadyAmplitudeOfAHarmonicWind) {
  const double step = 1.0 / 64, omega0 = 2 * std::numbers::pi * 0.7, omega = 2 * std::numbers::pi * 1.0;
  const Index n = 64 * 100;
  const transient::Newmark newmark(equations_of_motion(heave_with(0.0, 0.0), 10.0, 3.0), step);
  const MatrixXd load = MatrixXd::Constant(1, 1, 2.5);
  const Response found = respond(newmark, load, harmonic_wind(n, 100), step, Eigen::Vector2d(1.0, -3.0), {100.0});
  ASSERT_EQ(found.acceleration_m_s2.rows(), n);
  ASSERT_EQ(found.acceleration_m_s2.cols(), 2);
  const double amplitude =
      2.5 * omega * omega / std::abs(std::complex<double>(omega0 * omega0 - omega * omega, 2 * 0.02 * omega0 * omega));
  const VectorXd rms = root_mean_squares(found.acceleration_m_s2);
  EXPECT_NEAR(rms[0] / (amplitude / std::sqrt(2.0)), 1.0, 0.01);
  EXPECT_NEAR(rms[1] / rms[0], 3.0, 1e-12);
  // Above the natural frequency displacement opposes the load, so the acceleration goes with it.
  EXPECT_GT(found.acceleration_m_s2.col(0).dot(harmonic_wind(n, 100).col(0)), 0.0);
}

// The lead-in uses the end of a periodic sample, so the record begins in the steady state: its first and last second fit
// together as any two seconds of it do.
TEST(Respond, TheRecordIsPeriodic) {
  const double step = 1.0 / 32;
  const Index n = 32 * 60;
  const transient::Newmark newmark(equations_of_motion(heave_with(0.0, 0.0), 10.0, 3.0), step);
  const MatrixXd load = MatrixXd::Ones(1, 1), sensor = MatrixXd::Ones(1, 1);
  MatrixXd wind = harmonic_wind(n, 13) + harmonic_wind(n, 37);
  const MatrixXd once = respond(newmark, load, wind, step, sensor, {60.0}).acceleration_m_s2;
  MatrixXd shifted(n, 1);  // the same wind, begun 20 s later
  shifted << wind.bottomRows(n - 640), wind.topRows(640);
  const MatrixXd later = respond(newmark, load, shifted, step, sensor, {60.0}).acceleration_m_s2;
  // What is left of the start after 60 s: exp(-0.02 · 4.4 · 45) = 2 %.
  EXPECT_LT((later.topRows(n - 640) - once.bottomRows(n - 640)).norm() / once.norm(), 0.02);
}

// Without lead-in the structure starts from rest at the first sample. A lead-in longer than the sample goes through it again:
// after 205 s the record of 10 s is the steady one, which a sample of three times the length gives too. What is left of the
// start is exp(-0.02 · 4.4 t): 0.42 after 10 s, below 1e-4 after the unramped half of 205 s.
TEST(Respond, ALongLeadInRepeatsTheSample) {
  const double step = 1.0 / 32;
  const Index n = 32 * 10;
  const transient::Newmark newmark(equations_of_motion(heave_with(0.0, 0.0), 10.0, 3.0), step);
  const MatrixXd load = MatrixXd::Ones(1, 1), sensor = MatrixXd::Ones(1, 1), wind = harmonic_wind(n, 9);
  const MatrixXd none = respond(newmark, load, wind, step, sensor, {0.0}).acceleration_m_s2;
  const transient::History direct = newmark.run(load * wind.transpose());
  EXPECT_LT((none.transpose() - direct.acceleration).norm(), 1e-12 * none.norm());
  const MatrixXd whole = respond(newmark, load, wind, step, sensor, {10.0}).acceleration_m_s2;
  EXPECT_GT((whole - none).norm(), 0.1 * none.norm());
  const MatrixXd long_ago = respond(newmark, load, wind, step, sensor, {205.0}).acceleration_m_s2;
  MatrixXd thrice(3 * n, 1);
  thrice << wind, wind, wind;
  const MatrixXd steady = respond(newmark, load, thrice, step, sensor, {400.0}).acceleration_m_s2;
  EXPECT_LT((long_ago - steady.topRows(n)).norm(), 1e-3 * steady.topRows(n).norm());
  EXPECT_GT((whole - steady.topRows(n)).norm(), 0.01 * steady.topRows(n).norm());
}

// Linearity: two inputs act as the sum of each.
TEST(Respond, InputsAddUp) {
  const double step = 1.0 / 32;
  const transient::Newmark newmark(equations_of_motion(heave_with(-0.5, 0.1), 10.0, 3.0), step);
  MatrixXd wind(320, 2);
  wind << harmonic_wind(320, 5), harmonic_wind(320, 11);
  const MatrixXd sensor = MatrixXd::Ones(1, 1), load = Eigen::RowVector2d(2.0, -0.7);
  const MatrixXd both = respond(newmark, load, wind, step, sensor).acceleration_m_s2;
  const MatrixXd a = respond(newmark, load.leftCols(1), wind.leftCols(1), step, sensor).acceleration_m_s2,
                 b = respond(newmark, load.rightCols(1), wind.rightCols(1), step, sensor).acceleration_m_s2;
  EXPECT_LT((both - a - b).norm(), 1e-12 * both.norm());
}

// A sample that does not repeat brings its own run-up: that of a periodic one is its end.
TEST(Respond, ARunUpOfItsOwnIsTheSamplesFirstPart) {
  const double step = 1.0 / 32;
  const Index n = 32 * 10, lead = 32 * 4;
  const transient::Newmark newmark(equations_of_motion(heave_with(0.0, 0.0), 10.0, 3.0), step);
  const MatrixXd load = MatrixXd::Ones(1, 1), sensor = MatrixXd::Ones(1, 1), wind = harmonic_wind(n, 9) + harmonic_wind(n, 4);
  MatrixXd whole(lead + n, 1);
  whole << wind.bottomRows(lead), wind;
  const MatrixXd periodic = respond(newmark, load, wind, step, sensor, {4.0, true}).acceleration_m_s2,
                 own = respond(newmark, load, whole, step, sensor, {4.0, false}).acceleration_m_s2;
  ASSERT_EQ(own.rows(), n);
  EXPECT_LT((own - periodic).norm(), 1e-13 * periodic.norm());
}

}  // namespace
}  // namespace twindeck::buffeting
