// Oracles: the criteria of paper section 3.1 by hand, on either side of each bound; a zero change is stable (limit).
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "identification/clustering.hpp"

namespace twindeck::identification {
namespace {

using Complex = std::complex<double>;

/// A pole with the real shape (cos angle, sin angle): MAC of two of them is cos² of the difference of their angles.
Pole pole_at(double frequency_Hz, double damping_ratio, double angle = 0.0) {
  Pole pole;
  pole.frequency_Hz = frequency_Hz;
  pole.damping_ratio = damping_ratio;
  pole.shape = Eigen::Vector2cd(std::cos(angle), std::sin(angle));
  return pole;
}

DiagramPole second_of(const Pole& before, const Pole& pole, const StabilisationCriteria& criteria = {}) {
  const auto diagram = stabilisation_diagram({{before}, {pole}}, criteria, {});
  EXPECT_EQ(diagram.size(), 2U);
  return diagram.back();
}

TEST(StabilisationDiagram, ThePolesOfTheFirstOrderAreNotStable) {
  const auto diagram = stabilisation_diagram({{pole_at(1.0, 0.01), pole_at(2.0, 0.01)}}, {}, {});
  ASSERT_EQ(diagram.size(), 2U);
  for (const DiagramPole& pole : diagram) {
    EXPECT_FALSE(pole.stable_frequency || pole.stable_damping || pole.stable_shape);
    EXPECT_EQ(pole.mode, -1);
  }
}

TEST(StabilisationDiagram, TheSamePoleAgainIsStableInEachRespect) {
  EXPECT_TRUE(second_of(pole_at(1.0, 0.01), pole_at(1.0, 0.01)).stable());
}

// |f - f'| < 0.02 f with f of the pole itself: f' = 1.0 is 1.96 % of f = 1.02 away, and 2.04 % of f = 0.98.
TEST(StabilisationDiagram, AFrequencyIsComparedRelativeToThePoleItself) {
  EXPECT_TRUE(second_of(pole_at(1.0, 0.01), pole_at(1.02, 0.01)).stable_frequency);
  const DiagramPole below = second_of(pole_at(1.0, 0.01), pole_at(0.98, 0.01));
  EXPECT_FALSE(below.stable_frequency);
  EXPECT_FALSE(below.stable_damping || below.stable_shape);  // without a partner there is nothing to compare with
}

// One percentage point of damping, not one per cent of it.
TEST(StabilisationDiagram, DampingMayChangeByOnePercentagePoint) {
  EXPECT_TRUE(second_of(pole_at(1.0, 0.010), pole_at(1.0, 0.0199)).stable_damping);
  EXPECT_TRUE(second_of(pole_at(1.0, 0.0199), pole_at(1.0, 0.010)).stable_damping);
  const DiagramPole off = second_of(pole_at(1.0, 0.010), pole_at(1.0, 0.0201));
  EXPECT_FALSE(off.stable_damping);
  EXPECT_TRUE(off.stable_frequency && off.stable_shape);
  EXPECT_FALSE(off.stable());
}

// cos²(angle) = 0.95 at 12.92 degrees.
TEST(StabilisationDiagram, AShapeIsStableFromAMacOfNinetyFivePerCent) {
  const double bound = std::acos(std::sqrt(0.95));
  EXPECT_TRUE(second_of(pole_at(1.0, 0.01, 0.0), pole_at(1.0, 0.01, bound - 1e-6)).stable_shape);
  EXPECT_FALSE(second_of(pole_at(1.0, 0.01, 0.0), pole_at(1.0, 0.01, bound + 1e-6)).stable_shape);
}

// MAC does not see a complex factor of modulus one. The conjugate of a complex shape is another shape.
TEST(StabilisationDiagram, AShapesPhaseDoesNotMatter) {
  Pole before = pole_at(1.0, 0.01), pole = before;
  before.shape = Eigen::Vector2cd(Complex(1.0, 0.0), Complex(0.0, 1.0)).normalized();
  pole.shape = before.shape * std::polar(1.0, 2.3);
  EXPECT_TRUE(second_of(before, pole).stable_shape);
  pole.shape = before.shape.conjugate();
  EXPECT_FALSE(second_of(before, pole).stable_shape);
}

// Two close modes change their order in frequency: each is compared with the one of its own shape.
TEST(StabilisationDiagram, OfSeveralPartnersTheOneOfLikeShapeCounts) {
  const double right_angle = std::acos(0.0);
  const auto diagram = stabilisation_diagram(
      {{pole_at(1.000, 0.01), pole_at(1.005, 0.05, right_angle)}, {pole_at(1.001, 0.05, right_angle), pole_at(1.004, 0.01)}},
      {}, {});
  ASSERT_EQ(diagram.size(), 4U);
  EXPECT_TRUE(diagram[2].stable());
  EXPECT_TRUE(diagram[3].stable());
}

// Only the next smaller order counts, also where it has no pole.
TEST(StabilisationDiagram, AnOrderWithoutPolesBreaksTheChain) {
  const Pole pole = pole_at(1.0, 0.01);
  const auto diagram = stabilisation_diagram({{pole}, {}, {pole}, {pole}}, {}, {});
  ASSERT_EQ(diagram.size(), 3U);
  EXPECT_FALSE(diagram[1].stable_frequency);
  EXPECT_TRUE(diagram[2].stable());
}

TEST(StabilisationDiagram, PolesBeyondTheLimitsAreLeftOut) {
  PoleLimits limits;
  limits.lowest_Hz = 0.5;
  limits.highest_Hz = 2.0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto diagram = stabilisation_diagram(
      {{pole_at(0.49, 0.01), pole_at(0.5, 0.01), pole_at(2.0, 0.19), pole_at(2.01, 0.01), pole_at(1.0, 0.2), pole_at(1.0, 0.0),
        pole_at(1.0, -0.01), pole_at(nan, 0.01), pole_at(1.0, nan)}},
      {}, limits);
  ASSERT_EQ(diagram.size(), 2U);
  EXPECT_EQ(diagram[0].pole.frequency_Hz, 0.5);
  EXPECT_EQ(diagram[1].pole.frequency_Hz, 2.0);
}

// A pole that the limits refuse is no partner: 0.2 of damping stands one half a percentage point away.
TEST(StabilisationDiagram, APoleBeyondTheLimitsIsNoPartner) {
  const auto diagram = stabilisation_diagram({{pole_at(1.0, 0.2)}, {pole_at(1.0, 0.195)}}, {}, {});
  ASSERT_EQ(diagram.size(), 1U);
  EXPECT_FALSE(diagram.front().stable_frequency);
}

TEST(StabilisationDiagram, NoOrdersGiveNoDiagram) { EXPECT_TRUE(stabilisation_diagram({}, {}, {}).empty()); }

}  // namespace
}  // namespace twindeck::identification
