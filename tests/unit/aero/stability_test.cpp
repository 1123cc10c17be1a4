// Oracles: galloping and divergence of one degree of freedom in closed form; derivatives that act at one frequency alone.
#include "aero/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "known_derivatives.hpp"
#include "verification/wind_sections.hpp"

namespace {

using namespace twindeck;

constexpr double kMass = 1500.0, kChord = 4.5, kDensity = 1.25, kFrequency_Hz = 0.7;
const double still_omega = 2 * std::numbers::pi * kFrequency_Hz;

aero::AeroelasticSystem heaving(const aero::DerivativesPtr& derivatives, double damping_ratio) {
  return wind_test::section_model(wind_test::structure({kFrequency_Hz}, damping_ratio), kChord, kDensity, derivatives,
                                  {{0, 1 / std::sqrt(kMass), 0}});
}

aero::DerivativesPtr constant(std::size_t index, double value) {
  aero::Derivatives18 zasso{};
  zasso[index] = value;
  return std::make_shared<aero::ConstantZasso>(zasso);
}

// V = 4 m ω ξ/(ρ B |h1|), whatever the frequency of the derivatives.
TEST(Stability, GallopsFromItsClosedFormOn) {
  const double h1 = -1.5, ratio = 0.01, critical = 4 * kMass * still_omega * ratio / (kDensity * kChord * -h1);
  const aero::AeroelasticSystem system = heaving(constant(0, h1), ratio);
  EXPECT_FALSE(aero::find_growth(system, 0.999 * critical, {3.0, {0.5, 20.0}}));
  const auto found = aero::find_growth(system, 1.2 * critical, {3.0, {0.5, 20.0}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->motion.damping_ratio(), -0.2 * ratio, 1e-12);
  EXPECT_EQ(found->still_air_mode, 1);
  EXPECT_FALSE(found->at_own_frequency);
  EXPECT_EQ(found->in_words(), "mode 1 grows at 0.7 Hz, damping ratio -0.2 %");
}

// Without damping and wind nothing grows: rounding is no growth, beside a coordinate of 1 kHz too.
TEST(Stability, RoundingIsNoGrowth) {
  aero::ReducedStructure s = wind_test::structure({0.3, 0.7, 11.0, 1000.0}, 0.0);
  s.maxwell = {{5.0, 3.0, Eigen::Vector4d(0.0, 1e-3, 0.2, 0.5)}};
  const auto system =
      wind_test::section_model(s, kChord, kDensity, constant(0, 1.0), {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_FALSE(aero::find_growth(system, 10.0, {3.0, {0.5, 1e4}}));
}

// Pitch loses its stiffness at V² = 2 I ω²/(ρ B² a3).
TEST(Stability, DivergesWithoutOscillating) {
  const double inertia = 3000.0, a3 = 1.2,
               critical = std::sqrt(2 * inertia * still_omega * still_omega / (kDensity * kChord * kChord * a3));
  const auto system = wind_test::section_model(wind_test::structure({kFrequency_Hz}, 0.01), kChord, kDensity, constant(14, a3),
                                               {{0, 0, 1 / std::sqrt(inertia)}});
  EXPECT_FALSE(aero::find_growth(system, 0.999 * critical, {3.0, {0.5, 20.0}}));
  const auto found = aero::find_growth(system, 1.001 * critical, {3.0, {0.5, 20.0}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->in_words(), "mode 1 diverges without oscillating");
}

/// h1 below a reduced velocity alone, and refuses one below another.
class UpTo : public aero::FlutterDerivatives {
 public:
  UpTo(double h1, double highest, double refused) : h1_(h1), highest_(highest), refused_(refused) {}
  [[nodiscard]] aero::DerivativeBlock at(double, double v) const override {
    EXPECT_GE(v, refused_);
    aero::Derivatives18 zasso{};
    if (v <= highest_) zasso[0] = h1_;
    return to_block(aero::Convention::zasso, zasso, v);
  }

 private:
  double h1_, highest_, refused_;
};

// Frozen at half the mode's frequency the derivatives vanish, and at its own they do not. Frequencies outside the range are
// never asked for.
TEST(Stability, AModeIsAlsoHeldAgainstItsOwnFrequency) {
  const double h1 = -1.5, ratio = 0.01, speed = 1.2 * 4 * kMass * still_omega * ratio / (kDensity * kChord * -h1);
  const double at_mode = speed / (still_omega * kChord);
  const aero::AeroelasticSystem system = heaving(std::make_shared<UpTo>(h1, 1.5 * at_mode, 0.9 * at_mode), ratio);
  const auto found = aero::find_growth(system, speed, {0.5 * still_omega, {0.4 * still_omega, 1.1 * still_omega}});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->at_own_frequency);
  EXPECT_NEAR(found->motion.damping_ratio(), -0.2 * ratio, 1e-12);
  EXPECT_FALSE(aero::find_growth(system, speed,
                                 {0.5 * still_omega, {0.1 * still_omega, 0.6 * still_omega}}));  // of which the mode is no part
}

// Frozen at twice the mode's frequency h1 acts, and at the mode's own it vanishes: growth that the frozen derivatives alone
// show counts up to `frozen_to`. With h1 at all frequencies the same motion counts above it too.
TEST(Stability, AboveAFrequencyGrowthIsThatOfOwnDerivatives) {
  const double h1 = -1.5, ratio = 0.01, speed = 1.2 * 4 * kMass * still_omega * ratio / (kDensity * kChord * -h1);
  const double at_mode = speed / (still_omega * kChord), below = 0.9 * still_omega;
  const aero::AeroelasticSystem at_twice = heaving(std::make_shared<UpTo>(h1, 0.7 * at_mode, 0.0), ratio);
  const double frozen = 2.0 * still_omega;
  EXPECT_TRUE(aero::find_growth(at_twice, speed, {frozen, {0.1, below}}));
  EXPECT_FALSE(aero::find_growth(at_twice, speed, {frozen, {0.1, below}, below}));
  const auto found = aero::find_growth(heaving(constant(0, h1), ratio), speed, {frozen, {0.1, below}, below});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->at_own_frequency);
  EXPECT_NEAR(found->motion.damping_ratio(), -0.2 * ratio, 1e-12);
}

}  // namespace
