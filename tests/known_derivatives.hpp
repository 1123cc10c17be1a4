#pragma once

#include <cmath>
#include <numbers>

#include "aero/derivatives.hpp"

/// Flutter derivatives that are known in closed form, for tests.
namespace twindeck::aero {

/// Exact thin flat plate in potential flow, motion and moment about mid-chord (Theodorsen 1935), with C(k) = F + iG, k = K/2:
///   H1 = -2πF/K, H4 = π/2 + 2πG/K, K²H2 = πK/2 + 2π(G + FK/4), K²H3 = 2π(F - GK/4),
///   A1 = -(π/2)F/K, A4 = (π/2)G/K, K²A2 = (π/2)(G + FK/4 - K/4), K²A3 = (π/2)(F - GK/4 + K²/32).
class FlatPlate : public FlutterDerivatives {
 public:
  /// @param apparent_inertia  false leaves out the plate's apparent moment of inertia (the K²/32 above), as the flat plate of
  ///                          the IABSE TG 3.1 benchmark does: half a per cent of its torsional frequency
  explicit FlatPlate(bool apparent_inertia = true) : apparent_inertia_(apparent_inertia) {}
  [[nodiscard]] DerivativeBlock at(double, double v_over_omegaB) const override {
    using std::numbers::pi;
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

 private:
  bool apparent_inertia_;
};

/// The same eighteen values in Zasso's form at every angle and velocity.
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
