#pragma once

#include "aero/polar.hpp"

namespace twindeck::aero {

/// A section with linear coefficients, C(alpha) = C + C' alpha, up to 10 radians either way; exact at zero.
inline Polar linear_polar(const StaticCoefficients& at_zero) {
  const auto at = [&](double alpha) {
    StaticCoefficients c = at_zero;
    c.drag += c.drag_slope * alpha;
    c.lift += c.lift_slope * alpha;
    c.moment += c.moment_slope * alpha;
    return c;
  };
  return {{-10.0, 0.0, 10.0}, {at(-10.0), at_zero, at(10.0)}, "linear coefficients"};
}

}  // namespace twindeck::aero
