// Oracles: galloping and torsional flutter of one degree of freedom in closed form; divergence of a rigid section of two
// springs and of coordinates that all turn; Den Hartog's sum by hand; a derivative that grows as a power of V*.
#include <gtest/gtest.h>

#include <cmath>

#include "aero/follow_mode.hpp"
#include "aero/polar.hpp"
#include "core/units.hpp"
#include "known_derivatives.hpp"
#include "linear_polar.hpp"
#include "verification/wind_sections.hpp"

namespace {

using namespace twindeck;

constexpr double two_pi = 2 * std::numbers::pi;

aero::Branch first_branch(const aero::AeroelasticSystem& system, const std::vector<double>& speeds) {
  return aero::follow_mode(system, aero::still_air_modes(system.structure()).front(), 1, speeds);
}

// h1* = -V*^p alone.
class GrowingLift : public aero::FlutterDerivatives {
 public:
  explicit GrowingLift(double p) : p_(p) {}
  [[nodiscard]] aero::DerivativeBlock at(double, double v) const override {
    aero::Derivatives18 zasso{};
    zasso[0] = -std::pow(v, p_);
    return aero::to_block(aero::Convention::zasso, zasso, v);
  }

 private:
  double p_;
};

// Strips of given decks, yaws and lengths in wind along Y, with motions in z of one coordinate.
struct HeavingStrip {
  std::string deck;
  double yaw_rad, length_m, z;
};
aero::AeroelasticSystem heaving_strips(const std::vector<HeavingStrip>& list, const aero::DerivativesPtr& derivatives,
                                       const aero::StaticCoefficients& c = {}, const std::string& rule = "A") {
  const aero::Wind wind{1.25, Eigen::Vector3d::UnitY()};
  std::vector<aero::Strip> strips;
  std::vector<aero::StripMotion> motions;
  for (const HeavingStrip& s : list) {
    strips.push_back(aero::make_strip(s.deck, s.deck == "foot" ? 0 : 1, 0, s.length_m, {0, 0, 0},
                                      {std::cos(s.yaw_rad), -std::sin(s.yaw_rad), 0}, wind));
    motions.push_back(wind_test::motion({{0, s.z, 0}}));
  }
  const aero::Polar polar = aero::linear_polar(c);
  return {wind_test::structure({0.7}, 0.005),
          {{"foot", 4.5, polar, derivatives}, {"cycle", 5.0, polar, derivatives}},
          strips,
          motions,
          wind,
          aero::everywhere(aero::published_yaw_rule(rule))};
}

// Heave: 2 m ξω = ½ρVB |h1|, while h4 moves the frequency alone: ω² = ω0² - ½ρω²B²(π/2) h4/m.
TEST(CriticalPoint, GallopingMeetsItsClosedForm) {
  const double m = 1500, f = 0.7, xi = 0.005, B = 4.5, rho = 1.25, h1 = -2.0, h4 = 0.4;
  aero::Derivatives18 zasso{};
  zasso[0] = h1;
  zasso[3] = h4;
  const auto system = wind_test::section_model(wind_test::structure({f}, xi), B, rho,
                                               std::make_shared<aero::ConstantZasso>(zasso), {{0, 1 / std::sqrt(m), 0}});
  const auto found = aero::critical_point(system, first_branch(system, wind_test::speeds(1, 60, 7)));
  ASSERT_TRUE(found.has_value());
  // The bracket is refined to 1e-10 of the speed.
  EXPECT_NEAR(found->speed_m_s / (4 * m * two_pi * f * xi / (rho * B * std::abs(h1))), 1.0, 1e-9);
  const double added = 0.5 * rho * B * B * std::numbers::pi / 2 * h4 / m;
  EXPECT_NEAR(found->frequency_Hz / (f / std::sqrt(1 + added)), 1.0, 1e-9);
  EXPECT_NEAR(found->still_air_frequency_Hz / (f * std::sqrt(1 - xi * xi)), 1.0, 1e-12);
  EXPECT_NEAR(found->motion.damping_ratio(), 0.0, 1e-10);
  EXPECT_EQ(found->mode, 1);
}

// Pitch: M = -½ρVB³ a2 α̇ + ½ρV²B² a3 α, so V = 4 J ξω/(ρB³|a2|) and ω_c² = ω² - ½ρV²B² a3/J.
TEST(CriticalPoint, TorsionalFlutterMeetsItsClosedForm) {
  const double J = 4000, f = 1.5, xi = 0.01, B = 4.5, rho = 1.25, a2 = -0.6, a3 = 0.3;
  aero::Derivatives18 zasso{};
  zasso[13] = a2;
  zasso[14] = a3;
  const auto system = wind_test::section_model(wind_test::structure({f}, xi), B, rho,
                                               std::make_shared<aero::ConstantZasso>(zasso), {{0, 0, 1 / std::sqrt(J)}});
  const auto found = aero::critical_point(system, first_branch(system, wind_test::speeds(2, 40, 2)));
  ASSERT_TRUE(found.has_value());
  const double V = 4 * J * xi * two_pi * f / (rho * B * B * B * std::abs(a2));
  EXPECT_NEAR(found->speed_m_s / V, 1.0, 1e-9);
  EXPECT_NEAR(found->frequency_Hz / std::sqrt(f * f - 0.5 * rho * V * V * B * B * a3 / J / (two_pi * two_pi)), 1.0, 1e-9);
}

TEST(CriticalPoint, AModeThatStaysDampedHasNone) {
  aero::Derivatives18 zasso{};
  zasso[0] = 2.0;
  const auto system = wind_test::section_model(wind_test::structure({0.7}, 0.005), 4.5, 1.25,
                                               std::make_shared<aero::ConstantZasso>(zasso), {{0, 1 / std::sqrt(1500.0), 0}});
  EXPECT_FALSE(aero::critical_point(system, first_branch(system, wind_test::speeds(1, 20, 1))).has_value());
  EXPECT_FALSE(aero::critical_point(system, aero::Branch()).has_value());
}

// A mode may lose its damping, win it back and lose it again: the first speed counts. Here h1 changes its sign at V* = 2 and 6.
TEST(CriticalPoint, TheFirstLossOfDampingCounts) {
  struct Dip : aero::FlutterDerivatives {
    [[nodiscard]] aero::DerivativeBlock at(double, double v) const override {
      aero::Derivatives18 zasso{};
      zasso[0] = (v - 2.0) * (v - 6.0);
      return aero::to_block(aero::Convention::zasso, zasso, v);
    }
  };
  const double f = 0.7, B = 4.5;
  const auto system = wind_test::section_model(wind_test::structure({f}, 0.0), B, 1.25, std::make_shared<Dip>(),
                                               {{0, 1 / std::sqrt(1500.0), 0}});
  const auto found = aero::critical_point(system, first_branch(system, wind_test::speeds(5, 150, 5)));
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->speed_m_s / (2.0 * two_pi * f * B), 1.0, 1e-9);
}

// The deck with most of z² L, its share and its yaw weighted with z² L, by hand: 9·2 + 1·4 = 22 on foot, 4·3 = 12 on cycle.
TEST(GallopingCharacter, WeighsStripsWithTheSquareOfTheirMotion) {
  const auto system = heaving_strips({{"foot", 0.2, 2.0, 3.0}, {"cycle", 0.5, 3.0, -2.0}, {"foot", -0.4, 4.0, 1.0}},
                                     std::make_shared<GrowingLift>(2.5));
  const aero::ComplexMode still = aero::still_air_modes(system.structure()).front();
  for (const std::complex<double> phase :
       {std::complex<double>(1, 0), std::complex<double>(0, 1), std::complex<double>(-0.6, 0.8)}) {
    aero::ComplexMode motion = still;
    motion.vector *= phase;  // the phase of a mode is free
    const aero::GallopingCharacter found = aero::galloping_character(system, motion, 20.0);
    EXPECT_EQ(found.deck, "foot");
    EXPECT_NEAR(found.deck_share, 22.0 / 34.0, 1e-14);
    EXPECT_NEAR(found.theta_rms_rad, std::sqrt((18 * 0.04 + 4 * 0.16) / 22), 1e-14);
    // The exponent is a central difference over 0.1 % of a power law: exact but for rounding over that step.
    EXPECT_NEAR(found.exponent, 2.5, 1e-9);
  }
}

// J ω² = ½ρV²B²L C_M' of one rotation. Lift that rotation makes does not count: nothing turns with heave.
TEST(Divergence, HeaveAndPitchDivergeAtTheSpeedOfPitch) {
  const double J = 4000, f = 1.5, B = 4.5, rho = 1.25, slope = 0.6;
  const auto system = wind_test::section_model(
      wind_test::structure({0.7, f}, 0.01), B, rho, std::make_shared<aero::ConstantZasso>(aero::Derivatives18{}),
      {{0, 1 / std::sqrt(1500.0), 0}, {0, 0, 1 / std::sqrt(J)}}, {0.2, 0.1, 0.0, 0.3, 4.0, slope});
  const double expected = std::sqrt(J * std::pow(two_pi * f, 2) / (0.5 * rho * B * B * slope));
  EXPECT_NEAR(aero::divergence_speed(system).value() / expected, 1.0, 1e-12);
}

// Two coordinates that turn the section by a1 and a2 are springs in series: 1/(½ρV²B² C_M') = a1²/ω1² + a2²/ω2².
TEST(Divergence, CoordinatesThatTurnTogetherAreSpringsInSeries) {
  const double B = 4.5, rho = 1.25, slope = 0.6, a1 = 0.02, a2 = -0.015;
  const auto build = [&](double s) {
    return wind_test::section_model(wind_test::structure({0.9, 1.5}, 0.01), B, rho,
                                    std::make_shared<aero::ConstantZasso>(aero::Derivatives18{}), {{0, 0, a1}, {0, 0, a2}},
                                    {0, 0, 0, 0, 0, s});
  };
  const double flexibility = a1 * a1 / std::pow(two_pi * 0.9, 2) + a2 * a2 / std::pow(two_pi * 1.5, 2);
  EXPECT_NEAR(aero::divergence_speed(build(slope)).value() * std::sqrt(0.5 * rho * B * B * slope * flexibility), 1.0, 1e-12);
  EXPECT_FALSE(aero::divergence_speed(build(-slope)).has_value());
  EXPECT_FALSE(aero::divergence_speed(build(0.0)).has_value());
}

// V = 4 ωξ/(ρ sum B |h1| z² L), h1 = C_L' + C_D = -2.8: (4.5·9·2 + 5·4·3)·2.8 by hand.
TEST(DenHartog, SumsStripsOfBothDecks) {
  const aero::DerivativesPtr none = std::make_shared<aero::ConstantZasso>(aero::Derivatives18{});
  const std::vector<HeavingStrip> strips = {{"foot", 0, 2.0, 0.3}, {"cycle", 0, 3.0, -0.2}};
  const auto system = heaving_strips(strips, none, {0.2, 0.5, 0, 0, -3.0, 0});
  const double sum = 2.8 * (4.5 * 0.09 * 2 + 5.0 * 0.04 * 3);
  EXPECT_NEAR(aero::den_hartog_speed(system, 0).value() / (4 * two_pi * 0.7 * 0.005 / (1.25 * sum)), 1.0, 1e-12);
  EXPECT_FALSE(aero::den_hartog_speed(heaving_strips(strips, none, {0.2, 0, 0, 0, -0.1, 0}), 0).has_value());
  EXPECT_FALSE(aero::den_hartog_speed(heaving_strips(strips, none, {0.2, 0, 0, 0, -0.2, 0}), 0).has_value());
}

// Quasi-steady derivatives of the same polars in a normal wind give the same speed by following the mode.
TEST(DenHartog, IsTheCriticalSpeedOfQuasiSteadyDerivatives) {
  const aero::StaticCoefficients c{0.2, 0.5, 0, 0, -3.0, 0};
  const auto system = heaving_strips({{"foot", 0, 2.0, 0.03}, {"cycle", 0, 3.0, -0.02}},
                                     std::make_shared<aero::QuasiSteady>(aero::linear_polar(c), aero::QuasiSteady::Arms{}), c);
  const double expected = aero::den_hartog_speed(system, 0).value();
  const auto found = aero::critical_point(system, first_branch(system, {0.5 * expected, 1.5 * expected}));
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->speed_m_s / expected, 1.0, 1e-9);
}

// The bracket is refined to 1e-10 of the speed whatever the speed at which it starts.
TEST(CriticalPoint, GallopingIsFoundWhateverTheDamping) {
  aero::Derivatives18 zasso{};
  zasso[0] = -2.0;
  double worst = 0.0;
  int many = 0;
  for (int i = 1; i <= 400; ++i) {
    const double xi = 1e-4 * i, m = 1500;
    const auto system = wind_test::section_model(wind_test::structure({0.7}, xi), 4.5, 1.25,
                                                 std::make_shared<aero::ConstantZasso>(zasso), {{0, 1 / std::sqrt(m), 0}});
    const double expected = 4 * m * 2 * std::acos(-1.0) * 0.7 * xi / (1.25 * 4.5 * 2);
    const auto start = aero::still_air_modes(system.structure()).front();
    const auto found =
        aero::critical_point(system, aero::follow_mode(system, start, 1, wind_test::speeds(0.1, 1.1 * expected + 1, 1)));
    const double error = found ? std::abs(found->speed_m_s / expected - 1) : 9;
    many += error > 1e-9;
    worst = std::max(worst, error);
  }
  EXPECT_EQ(many, 0);
  EXPECT_LT(worst, 1e-9);
}

// A first speed beyond the critical one: damping is lost between still air and it.
TEST(CriticalPoint, IsFoundBelowTheFirstSpeed) {
  aero::Derivatives18 zasso{};
  zasso[0] = -2.0;
  const auto system = wind_test::section_model(wind_test::structure({0.7}, 0.005), 4.5, 1.25,
                                               std::make_shared<aero::ConstantZasso>(zasso), {{0, 1 / std::sqrt(1500.0), 0}});
  const double expected = 4 * 1500.0 * 2 * std::acos(-1.0) * 0.7 * 0.005 / (1.25 * 4.5 * 2);
  const auto start = aero::still_air_modes(system.structure()).front();
  const auto found = aero::critical_point(system, aero::follow_mode(system, start, 1, {20.0, 40.0}));
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->speed_m_s / expected, 1.0, 1e-9);
}

// Oracle: without structural damping any lift that falls with heave is unstable: from the first speed that is asked for, and it
// may be lost anywhere below. A section that the wind does not touch stays as it is.
TEST(CriticalPoint, AModeWithoutDampingIsUnstableFromTheFirstSpeedOn) {
  for (const double h1 : {-2.0, 0.0}) {
    aero::Derivatives18 zasso{};
    zasso[0] = h1;
    const auto system = wind_test::section_model(wind_test::structure({0.7}, 0.0), 4.5, 1.25,
                                                 std::make_shared<aero::ConstantZasso>(zasso), {{0, 1 / std::sqrt(1500.0), 0}});
    const auto found = aero::critical_point(system, first_branch(system, {20.0, 40.0}));
    ASSERT_EQ(found.has_value(), h1 < 0.0);
    if (!found) continue;
    EXPECT_EQ(found->speed_m_s, 20.0);
    EXPECT_EQ(found->bracket_m_s, 20.0);
  }
}

}  // namespace
