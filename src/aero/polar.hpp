#pragma once

#include <string>
#include <vector>

#include "aero/derivatives.hpp"

namespace twindeck::aero {

/// Static coefficients and their slopes at one angle of attack, all on the chord B:  D = qB C_D, L = qB C_L, M = qB² C_M.
struct StaticCoefficients {
  double drag = 0.0, lift = 0.0, moment = 0.0;
  double drag_slope = 0.0, lift_slope = 0.0, moment_slope = 0.0;  ///< [1/rad]
};

/// C_D, C_L, C_M and slopes over the angle of attack, linear between rows.
class Polar {
 public:
  /// @param alpha_rad  ascending, nose-up
  /// @param source     where the numbers came from, for messages
  Polar(std::vector<double> alpha_rad, std::vector<StaticCoefficients> rows, std::string source);

  /// @throws InputError  outside the table, naming its range
  [[nodiscard]] StaticCoefficients at(double alpha_rad) const;
  /// Whether `at` has a value there.
  [[nodiscard]] bool covers(double alpha_rad) const;
  /// The polar with lift scaled about its value at alpha = 0: C_L -> C_L(0) + factor (C_L - C_L(0)), C_L' -> factor C_L'.
  [[nodiscard]] Polar with_lift_slope_factor(double factor) const;
  [[nodiscard]] const std::vector<double>& alpha_rad() const { return alpha_rad_; }
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  std::vector<double> alpha_rad_;
  std::vector<StaticCoefficients> rows_;
  std::string source_;
};

/// Flutter derivatives of quasi-steady theory, computed from a polar, in Zasso's form:
///   h1 = C_L' + C_D, h3 = C_L', h5 = 2C_L;  p1 = C_D' - C_L, p3 = C_D', p5 = 2C_D;  a1 = a3 = C_M', a5 = 2C_M;
///   h2 = mu_L h1, p2 = mu_D p1, a2 = mu_M a1; the rest are zero.
/// A rate of rotation acts like the velocity of the point of the chord at the distance mu from the axis, 0 unless it is given.
class QuasiSteady : public FlutterDerivatives {
 public:
  struct Arms {
    double drag = 0.0, lift = 0.0, moment = 0.0;  ///< mu_D, mu_L, mu_M, each divided by the chord B
  };
  QuasiSteady(Polar polar, const Arms& arms);
  [[nodiscard]] DerivativeBlock at(double alpha_rad, double v_over_omegaB) const override;
  [[nodiscard]] bool covers(double alpha_rad, double /*v_over_omegaB*/) const override { return polar_.covers(alpha_rad); }

 private:
  Polar polar_;
  Arms arms_;
};

}  // namespace twindeck::aero
