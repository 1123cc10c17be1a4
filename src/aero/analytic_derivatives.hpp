#pragma once

#include "aero/flutter_derivatives.hpp"
#include "aero/polar.hpp"

namespace twindeck::aero {

/// Exact thin flat plate in potential flow, motion and moment about mid-chord (Theodorsen 1935), with C(k) = F + iG, k = K/2:
///   H1 = -2πF/K, H4 = π/2 + 2πG/K, K²H2 = πK/2 + 2π(G + FK/4), K²H3 = 2π(F - GK/4),
///   A1 = -(π/2)F/K, A4 = (π/2)G/K, K²A2 = (π/2)(G + FK/4 - K/4), K²A3 = (π/2)(F - GK/4 + K²/32).
class FlatPlate : public FlutterDerivatives {
 public:
  /// @param apparent_inertia  false leaves out the plate's apparent moment of inertia (the K²/32 above), as the flat plate of
  /// the
  ///                          IABSE TG 3.1 benchmark does: half a per cent of its torsional frequency
  explicit FlatPlate(bool apparent_inertia = true) : apparent_inertia_(apparent_inertia) {}
  [[nodiscard]] DerivativeBlock at(double alpha_rad, double v_over_omegaB) const override;

 private:
  bool apparent_inertia_;
};

/// Quasi-steady derivatives from a polar, the arm of the rotational rate mu = 0 or as given (Zasso's form):
///   h1 = C_L' + C_D, h3 = C_L', h5 = 2C_L;  p1 = C_D' - C_L, p3 = C_D', p5 = 2C_D;  a1 = a3 = C_M', a5 = 2C_M;
///   h2 = mu_L h1, p2 = mu_D p1, a2 = mu_M a1; the rest zero.
class QuasiSteady : public FlutterDerivatives {
 public:
  struct Arms {
    double drag = 0.0, lift = 0.0, moment = 0.0;  ///< mu over B
  };
  explicit QuasiSteady(Polar polar);
  QuasiSteady(Polar polar, const Arms& arms);
  [[nodiscard]] DerivativeBlock at(double alpha_rad, double v_over_omegaB) const override;

 private:
  Polar polar_;
  Arms arms_;
};

/// The same eighteen values in Zasso's form at every angle and velocity: closed-form checks.
class ConstantZasso : public FlutterDerivatives {
 public:
  explicit ConstantZasso(const Derivatives18& values) : values_(values) {}
  [[nodiscard]] DerivativeBlock at(double, double v_over_omegaB) const override {
    return to_block(Convention::zasso, values_, v_over_omegaB);
  }

 private:
  Derivatives18 values_;
};

}  // namespace twindeck::aero
