// Oracles: quasi-steady theory, whose damping follows from the relative wind by hand; limits and a tabulated value of
// Theodorsen's function; the inverse of each conversion.
#include "aero/derivatives.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "aero/polar.hpp"
#include "known_derivatives.hpp"
#include "linear_polar.hpp"

namespace {

using namespace twindeck;
using aero::Convention;

TEST(Derivatives, EachOfEighteenHasItsOwnPlaceAndReturns) {
  for (const Convention convention : {Convention::zasso, Convention::scanlan}) {
    for (std::size_t i = 0; i < 18; ++i) {
      aero::Derivatives18 one{};
      one[i] = 0.7;
      const aero::DerivativeBlock block = aero::to_block(convention, one, 1.7);
      EXPECT_EQ((block.damping.array() != 0).count() + (block.stiffness.array() != 0).count(), 1);
      const aero::Derivatives18 back = aero::from_block(convention, block, 1.7);
      for (std::size_t j = 0; j < 18; ++j) EXPECT_NEAR(back[j], one[j], 1e-15);
    }
  }
}

// D = ½ρB C_D |V_rel|² and its lift, linearised by hand for a section at zero angle: ẏ reduces the wind, ż turns it downwards.
TEST(Derivatives, QuasiSteadyForcesAreThoseOfTheRelativeWind) {
  const aero::StaticCoefficients c{0.2, -0.06, 0.02, 0.3, -5.86, 0.25};
  const aero::QuasiSteady derivatives{aero::linear_polar(c), {}};
  const double V = 20.0, B = 4.5, omega = 4.6, rate = 1e-4;
  const aero::DerivativeBlock d = derivatives.at(0.0, V / (omega * B));
  const auto force = [&](double ydot, double zdot) {
    const double u = V - ydot, w = -zdot, alpha = std::atan2(w, u), q = u * u + w * w;
    const double drag = c.drag + c.drag_slope * alpha, lift = c.lift + c.lift_slope * alpha;
    return Eigen::Vector2d(q * (drag * std::cos(alpha) - lift * std::sin(alpha)),
                           q * (drag * std::sin(alpha) + lift * std::cos(alpha)));
  };
  const Eigen::Vector2d by_y = (force(rate, 0) - force(-rate, 0)) / (2 * rate),
                        by_z = (force(0, rate) - force(0, -rate)) / (2 * rate);
  // ½ρωB² H against ½ρB times the derivative of q C.
  for (int row = 0; row < 2; ++row) {
    EXPECT_NEAR(omega * B * d.damping(row, 0), by_y(row), 1e-6 * V);
    EXPECT_NEAR(omega * B * d.damping(row, 1), by_z(row), 1e-6 * V);
  }
}

TEST(Derivatives, FlatPlateTendsToThinAerofoilTheory) {
  // Slow motion: K² H3 -> 2π, K² A3 -> π/2, H1 -> -2π/K.
  const aero::DerivativeBlock d = aero::FlatPlate().at(0.0, 1e4);
  const double K = 1e-4;
  EXPECT_NEAR(d.stiffness(1, 2) * K * K, 2 * std::numbers::pi, 2e-3);
  EXPECT_NEAR(d.stiffness(2, 2) * K * K, std::numbers::pi / 2, 5e-4);
  EXPECT_NEAR(d.damping(1, 1) * K, -2 * std::numbers::pi, 2e-3);
  // Theodorsen's table: C(0.5) = 0.5979 - 0.1507 i.
  const aero::DerivativeBlock half = aero::FlatPlate().at(0.0, 1.0);
  EXPECT_NEAR(-half.damping(1, 1) / (2 * std::numbers::pi), 0.5979, 5e-5);
  EXPECT_NEAR((half.stiffness(1, 1) - std::numbers::pi / 2) / (2 * std::numbers::pi), -0.1507, 5e-5);
}

}  // namespace
