#include "aero/analytic_derivatives.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace twindeck::aero {

using std::numbers::pi;

DerivativeBlock FlatPlate::at(double, double v_over_omegaB) const {
  const double K = 1.0 / v_over_omegaB, k = K / 2;
  // C(k) = H1/(H1 + i H0) with Hankel functions of the second kind, H_n = J_n - i Y_n.
  const double j0 = std::cyl_bessel_j(0.0, k), j1 = std::cyl_bessel_j(1.0, k);
  const double y0 = std::cyl_neumann(0.0, k), y1 = std::cyl_neumann(1.0, k);
  const double size = (j1 + y0) * (j1 + y0) + (y1 - j0) * (y1 - j0);
  const double F = (j1 * (j1 + y0) + y1 * (y1 - j0)) / size;
  const double G = -(y1 * y0 + j1 * j0) / size;
  const double inertia = apparent_inertia_ ? K * K / 32 : 0.0;
  DerivativeBlock block;
  const double H1 = -2 * pi * F / K, H2 = (pi * K / 2 + 2 * pi * (G + F * K / 4)) / (K * K);
  const double H3 = 2 * pi * (F - G * K / 4) / (K * K), H4 = pi / 2 + 2 * pi * G / K;
  const double A1 = -pi / 2 * F / K, A2 = pi / 2 * (G + F * K / 4 - K / 4) / (K * K);
  const double A3 = pi / 2 * (F - G * K / 4 + inertia) / (K * K), A4 = pi / 2 * G / K;
  block.damping << 0, 0, 0, 0, H1, H2, 0, A1, A2;
  block.stiffness << 0, 0, 0, 0, H4, H3, 0, A4, A3;
  return block;
}

QuasiSteady::QuasiSteady(Polar polar) : QuasiSteady(std::move(polar), Arms{}) {}

QuasiSteady::QuasiSteady(Polar polar, const Arms& arms) : polar_(std::move(polar)), arms_(arms) {}

DerivativeBlock QuasiSteady::at(double alpha_rad, double v_over_omegaB) const {
  const StaticCoefficients c = polar_.at(alpha_rad);
  const double h1 = c.lift_slope + c.drag, p1 = c.drag_slope - c.lift, a1 = c.moment_slope;
  const Derivatives18 zasso = {h1, arms_.lift * h1,   c.lift_slope,   0, 2 * c.lift,   0,  //
                               p1, arms_.drag * p1,   c.drag_slope,   0, 2 * c.drag,   0,
                               a1, arms_.moment * a1, c.moment_slope, 0, 2 * c.moment, 0};
  return to_block(Convention::zasso, zasso, v_over_omegaB);
}

}  // namespace twindeck::aero
