#pragma once

#include "aero/flutter_derivatives.hpp"
#include "aero/polar.hpp"

namespace twindeck::aero {

/// Quasi-steady derivatives from a polar, the arm of the rotational rate mu = 0 or as given (Zasso's form):
///   h1 = C_L' + C_D, h3 = C_L', h5 = 2C_L;  p1 = C_D' - C_L, p3 = C_D', p5 = 2C_D;  a1 = a3 = C_M', a5 = 2C_M;
///   h2 = mu_L h1, p2 = mu_D p1, a2 = mu_M a1; the rest zero.
class QuasiSteady : public FlutterDerivatives {
 public:
  struct Arms {
    double drag = 0.0, lift = 0.0, moment = 0.0;  ///< mu over B
  };
  QuasiSteady(Polar polar, const Arms& arms);
  [[nodiscard]] DerivativeBlock at(double alpha_rad, double v_over_omegaB) const override;
  [[nodiscard]] bool covers(double alpha_rad, double /*v_over_omegaB*/) const override { return polar_.covers(alpha_rad); }

 private:
  Polar polar_;
  Arms arms_;
};

}  // namespace twindeck::aero
