#include "aero/analytic_derivatives.hpp"

#include <utility>

namespace twindeck::aero {

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
