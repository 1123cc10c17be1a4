#pragma once

#include <memory>

#include "aero/derivatives.hpp"

namespace twindeck::aero {

/// Flutter derivatives of a section as a function of angle of attack and reduced velocity, from any source.
class FlutterDerivatives {
 public:
  virtual ~FlutterDerivatives() = default;
  /// @param alpha_rad      mean angle of attack, nose-up
  /// @param v_over_omegaB  V* = V/(omega B) = 1/K; a wind tunnel's V/(f B) is 2π times that
  [[nodiscard]] virtual DerivativeBlock at(double alpha_rad, double v_over_omegaB) const = 0;
  /// Whether `at` has a value there; false where it would refuse.
  [[nodiscard]] virtual bool covers(double /*alpha_rad*/, double /*v_over_omegaB*/) const { return true; }
};
using DerivativesPtr = std::shared_ptr<const FlutterDerivatives>;

}  // namespace twindeck::aero
