// Oracles: roots of one degree of freedom in closed form; the characteristic polynomial of a Maxwell unit; the determinant of
// the equation that is solved, with forces at the mode's own frequency; the path does not count.
#include "aero/follow_mode.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "known_derivatives.hpp"
#include "verification/wind_sections.hpp"

namespace {

using namespace twindeck;
using Root = std::complex<double>;

// A heaving section of mass 1500 kg, chord 4.5 m, with lift -½ρVB h1 ż.
aero::AeroelasticSystem heaving(double h1, double damping_ratio) {
  aero::Derivatives18 zasso{};
  zasso[0] = h1;
  return wind_test::section_model(wind_test::structure({0.7}, damping_ratio), 4.5, 1.25,
                                  std::make_shared<aero::ConstantZasso>(zasso), {{0, 1 / std::sqrt(1500.0), 0}});
}

aero::AeroelasticSystem plate_in_heave_and_pitch() {
  return wind_test::section_model(wind_test::structure({0.1, 0.278}, 0.003), 31, 1.22, std::make_shared<aero::FlatPlate>(),
                                  {{0, 1 / std::sqrt(22740.0), 0}, {0, 0, 1 / std::sqrt(2.47e6)}});
}

// By hand: λ = -3 + 4i has |λ| = 5.
TEST(ComplexMode, FrequencyAndDampingByHand) {
  const aero::ComplexMode mode{{-3.0, 4.0}, {}}, growing{{3.0, 4.0}, {}};
  EXPECT_DOUBLE_EQ(mode.damping_ratio(), 0.6);
  EXPECT_DOUBLE_EQ(mode.frequency_Hz(), 4.0 / (2 * std::acos(-1.0)));
  EXPECT_DOUBLE_EQ(growing.damping_ratio(), -0.6);
}

// λ = -ξω + iω sqrt(1 - ξ²), by the size of λ whatever the order of the coordinates; a coordinate that does not oscillate is
// left out.
TEST(StillAirModes, AreTheRootsOfEachCoordinate) {
  aero::ReducedStructure s;
  s.omega_rad_s = Eigen::Vector4d(7.0, 2.0, 4.0, 3.0);
  s.damping_ratio = Eigen::Vector4d(0.02, 0.3, 1.5, 0.0);
  const auto modes = aero::still_air_modes(s);
  ASSERT_EQ(modes.size(), 3U);
  const std::vector<Eigen::Index> order = {1, 3, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = s.omega_rad_s(order[i]), xi = s.damping_ratio(order[i]);
    EXPECT_LT(std::abs(modes[i].lambda - Root(-xi * w, w * std::sqrt(1 - xi * xi))), 1e-13 * w);
    EXPECT_NEAR(modes[i].damping_ratio(), xi, 1e-13);
    EXPECT_NEAR(std::abs(modes[i].vector(order[i])), 1.0, 1e-13);
    EXPECT_NEAR(modes[i].vector.norm(), 1.0, 1e-14);
  }
}

// det(λ² + λC + Λ + sum k λc/(k + λc) d d') = 0 with dashpots and a Maxwell unit across two coordinates.
TEST(StillAirModes, DashpotsAndMaxwellUnitsSatisfyTheCharacteristicEquation) {
  aero::ReducedStructure s;
  s.omega_rad_s = Eigen::Vector2d(2.0, 3.0);
  s.damping_ratio = Eigen::Vector2d(0.01, 0.02);
  s.viscous = 0.1 * Eigen::Vector2d(1, -1) * Eigen::RowVector2d(1, -1);
  s.maxwell = {{3.0, 0.5, Eigen::Vector2d(1.0, 0.4)}};
  const auto modes = aero::still_air_modes(s);
  ASSERT_EQ(modes.size(), 2U);
  for (const aero::ComplexMode& mode : modes) {
    const Root l = mode.lambda;
    Eigen::Matrix2cd d = l * s.damping().cast<Root>();
    d.diagonal().array() += l * l;
    d.diagonal() += Eigen::Vector2cd(4.0, 9.0);
    d += 3.0 * l * 0.5 / (3.0 + l * 0.5) * (s.maxwell[0].direction * s.maxwell[0].direction.transpose()).cast<Root>();
    EXPECT_LT((d * mode.vector).norm(), 1e-12);
    EXPECT_GT(mode.damping_ratio(), 0.0);
  }
}

// One degree of freedom: λ² + 2 (ξω + ρVB h1/(4 m)) λ + ω² = 0, growing or damped.
TEST(FollowMode, AHeavingSectionHasItsClosedForm) {
  const double omega = 2 * std::acos(-1.0) * 0.7, xi = 0.01;
  for (const double h1 : {-3.0, 2.0}) {
    const aero::AeroelasticSystem system = heaving(h1, xi);
    const aero::ComplexMode start = aero::still_air_modes(system.structure()).front();
    const aero::Branch branch = aero::follow_mode(system, start, 1, wind_test::speeds(5, 40, 5));
    ASSERT_TRUE(branch.status.converged) << branch.status.message;
    ASSERT_EQ(branch.points.size(), 8U);
    EXPECT_EQ(branch.mode, 1);
    EXPECT_EQ(branch.still_air.lambda, start.lambda);
    for (std::size_t i = 0; i < 8; ++i) {
      const double decay = xi * omega + 1.25 * branch.speed_m_s[i] * 4.5 * h1 / (4 * 1500.0);
      // The last Newton step is below 1e-12 of |λ|.
      EXPECT_LT(std::abs(branch.points[i].lambda - Root(-decay, std::sqrt(omega * omega - decay * decay))), 1e-11 * omega);
    }
  }
}

// Heave and pitch of a flat plate: (λ² + λ(C - Ca) + Λ - Ka) v = 0 with Ca, Ka at Im λ, which the test assembles again.
TEST(FollowMode, EachPointSatisfiesTheEquationAtItsOwnFrequency) {
  const aero::AeroelasticSystem system = plate_in_heave_and_pitch();
  const auto starts = aero::still_air_modes(system.structure());
  const aero::Branch pitch = aero::follow_mode(system, starts[1], 2, wind_test::speeds(5, 80, 5));
  ASSERT_TRUE(pitch.status.converged) << pitch.status.message;
  for (std::size_t i = 0; i < pitch.points.size(); ++i) {
    const Root l = pitch.points[i].lambda;
    const auto air = system.self_excited(pitch.speed_m_s[i], l.imag());
    Eigen::Matrix2cd d = l * (system.structure().damping() - air.damping).cast<Root>() - air.stiffness.cast<Root>();
    d.diagonal() += system.structure().omega_rad_s.cwiseAbs2().cast<Root>();
    d.diagonal().array() += l * l;
    EXPECT_LT((d * pitch.points[i].vector).norm(), 1e-10) << pitch.speed_m_s[i];
    EXPECT_NEAR(pitch.points[i].vector.norm(), 1.0, 1e-14);
  }
}

// A mode is a function of the speed, so the steps on the way to it do not count. Dashpots and a Maxwell unit take part.
TEST(FollowMode, ThePathDoesNotCount) {
  const aero::AeroelasticSystem plain = plate_in_heave_and_pitch();
  aero::ReducedStructure s = plain.structure();
  s.viscous = 0.01 * Eigen::Matrix2d::Identity();
  s.maxwell = {{0.2, 0.1, Eigen::Vector2d(1.0, 0.3)}};
  const aero::AeroelasticSystem system(s, plain.sections(), plain.strips(), plain.motions(), plain.wind(), plain.deployment());
  const aero::ComplexMode start = aero::still_air_modes(s)[1];
  const Root fine = aero::follow_mode(system, start, 2, wind_test::speeds(0.5, 60, 0.5)).points.back().lambda;
  const Root coarse = aero::follow_mode(system, start, 2, {60.0}).points.back().lambda;
  EXPECT_LT(std::abs(fine - coarse), 1e-10 * std::abs(fine));
  EXPECT_LT(std::abs(aero::mode_at(system, start, 0.0, 60.0).value().lambda - fine), 1e-10 * std::abs(fine));
  const Root l = fine;
  const auto air = system.self_excited(60.0, l.imag());
  Eigen::Matrix2cd d = l * (s.damping() - air.damping).cast<Root>() - air.stiffness.cast<Root>();
  d.diagonal() += s.omega_rad_s.cwiseAbs2().cast<Root>();
  d.diagonal().array() += l * l;
  d += 0.2 * l * 0.1 / (0.2 + l * 0.1) * (s.maxwell[0].direction * s.maxwell[0].direction.transpose()).cast<Root>();
  EXPECT_LT(std::abs(d.determinant()), 1e-9);
}

// Heave with h1 > 0 stops oscillating where ξω + ρVB h1/(4 m) = ω. The branch says so and keeps the points before.
TEST(FollowMode, AModeThatStopsOscillatingIsAStatusOfNoConvergence) {
  const double omega = 2 * std::acos(-1.0) * 0.7, xi = 0.01, h1 = 40.0;
  const double last = 4 * 1500.0 * omega * (1 - xi) / (1.25 * 4.5 * h1);
  const aero::AeroelasticSystem system = heaving(h1, xi);
  const aero::ComplexMode start = aero::still_air_modes(system.structure()).front();
  const aero::Branch branch = aero::follow_mode(system, start, 7, {0.5 * last, 0.9 * last, 1.1 * last, 0.5 * last});
  EXPECT_FALSE(branch.status.converged);
  EXPECT_NE(branch.status.message.find("mode 7"), std::string::npos) << branch.status.message;
  EXPECT_NE(branch.status.message.find(std::to_string(0.9 * last)), std::string::npos) << branch.status.message;
  EXPECT_EQ(branch.points.size(), 2U);
  EXPECT_EQ(branch.speed_m_s.size(), 2U);
  EXPECT_FALSE(aero::mode_at(system, start, 0.0, 1.1 * last).has_value());
}

// A mode that the wind does not touch stays as it is. Its λ is exact, so the matrix of the iteration has no inverse.
TEST(FollowMode, AModeThatTheWindDoesNotTouchIsFollowed) {
  aero::ReducedStructure s;
  s.omega_rad_s = Eigen::VectorXd::Constant(1, 2.0);
  s.damping_ratio = Eigen::VectorXd::Zero(1);
  const auto system = wind_test::section_model(s, 4.5, 1.25, std::make_shared<aero::ConstantZasso>(aero::Derivatives18{}),
                                               {{0, 1 / std::sqrt(1500.0), 0}});
  const aero::Branch branch = aero::follow_mode(system, {{0.0, 2.0}, Eigen::VectorXcd::Ones(1)}, 1, {1.0, 2.0});
  ASSERT_TRUE(branch.status.converged) << branch.status.message;
  EXPECT_LT(std::abs(branch.points.back().lambda - Root(0.0, 2.0)), 1e-12);
}

}  // namespace
