// Oracles: the relative wind at a point that moves, linearised by differences; the moment about mid-chord of the same; arms of
// the rotational rate by hand; the static slope as the limit of a slow rotation.
#include <gtest/gtest.h>

#include <cmath>

#include "aero/polar.hpp"
#include "linear_polar.hpp"

namespace {

using namespace twindeck;

const aero::StaticCoefficients every_coefficient{0.2, -0.06, 0.02, 0.3, -5.86, 0.25};

// Forces per ½ρB (moment: per ½ρB²) in a wind of 1 m/s on a section that moves with ẏ, ż and is turned nose-up by alpha.
Eigen::Vector3d of_relative_wind(double ydot, double zdot, double alpha) {
  const double u = 1.0 - ydot, w = -zdot, turn = std::atan2(w, u), a = turn + alpha, q = u * u + w * w;
  const aero::StaticCoefficients c = aero::linear_polar(every_coefficient).at(a);
  return q * Eigen::Vector3d(c.drag * std::cos(turn) - c.lift * std::sin(turn),
                             c.drag * std::sin(turn) + c.lift * std::cos(turn), c.moment);
}

// K X_damping = change per velocity over V, K² X_stiffness = change per rotation; steps of 1e-5 leave errors of 1e-9.
TEST(QuasiSteady, DerivativesAreThoseOfTheRelativeWind) {
  const double step = 1e-5, v = 3.7, K = 1.0 / v;
  const aero::DerivativeBlock d = aero::QuasiSteady(aero::linear_polar(every_coefficient), {}).at(0.0, v);
  const auto slope = [&](double y, double z, double a) {
    return Eigen::Vector3d(
        (of_relative_wind(y * step, z * step, a * step) - of_relative_wind(-y * step, -z * step, -a * step)) / (2 * step));
  };
  EXPECT_LT((K * d.damping.col(0) - slope(1, 0, 0)).norm(), 1e-8);
  EXPECT_LT((K * d.damping.col(1) - slope(0, 1, 0)).norm(), 1e-8);
  EXPECT_LT((K * K * d.stiffness.col(2) - slope(0, 0, 1)).norm(), 1e-8);
  // Without arms nothing goes with the rotational rate, and nothing with the displacements.
  EXPECT_EQ(d.damping.col(2), Eigen::Vector3d::Zero());
  EXPECT_TRUE(d.stiffness.leftCols<2>().isZero(0.0));
}

// A rotational rate acts as a heave velocity at the arm mu B. Each force has an arm of its own.
TEST(QuasiSteady, ARotationalRateActsByItsArm) {
  const aero::DerivativeBlock d = aero::QuasiSteady(aero::linear_polar(every_coefficient), {-0.1, 0.2, 0.3}).at(0.0, 2.0);
  EXPECT_NEAR(d.damping(0, 2), -0.1 * d.damping(0, 1), 1e-15);
  EXPECT_NEAR(d.damping(1, 2), 0.2 * d.damping(1, 1), 1e-14);
  EXPECT_NEAR(d.damping(2, 2), 0.3 * d.damping(2, 1), 1e-15);
}

// At a mean angle the coefficients are those of the polar there: H1 = -V* (C_L' + C_D), P1 = -V* 2 C_D, A5 = -V* 2 C_M.
TEST(QuasiSteady, CoefficientsAreThoseAtTheMeanAngle) {
  const double alpha = 0.03, v = 1.5;
  const aero::DerivativeBlock d = aero::QuasiSteady(aero::linear_polar(every_coefficient), {}).at(alpha, v);
  EXPECT_NEAR(d.damping(1, 1), -v * (-5.86 + 0.2 + 0.3 * alpha), 1e-13);
  EXPECT_NEAR(d.damping(0, 0), -v * 2 * (0.2 + 0.3 * alpha), 1e-14);
  EXPECT_NEAR(d.damping(0, 1), -v * (0.3 + 0.06 + 5.86 * alpha), 1e-14);
  EXPECT_NEAR(d.damping(2, 0), -v * 2 * (0.02 + 0.25 * alpha), 1e-15);
}

}  // namespace
