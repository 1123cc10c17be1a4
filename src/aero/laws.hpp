#pragma once

#include <string>
#include <vector>

#include "aero/derivative_table.hpp"
#include "aero/derivatives.hpp"
#include "aero/polar.hpp"

/// Laws that aerodynamic data of a deck section normally obey; a wrong sign in a file breaks one of them. They compare the
/// polar with the flutter derivatives, and both with the signs that hold for decks. They do not check magnitudes.
namespace twindeck::aero {

/// A law that a set of data breaks.
struct BrokenLaw {
  std::string law;   ///< its name, one of law_names()
  std::string told;  ///< location and values, for a message
};

/// drag: C_D > 0 at every angle.
/// slopes: the polar's slopes are those of its own coefficients (central differences).
/// moment_slope: C_M' is not negative at the angle nearest to zero. Pressure acts upwind of mid-chord, as on a thin plate
///   (C_M' = π/2) and on bridge decks, so that wind takes stiffness from pitching.
/// pitching_damping: a2* is not negative (A2* not positive) at the lowest reduced velocity and the angle nearest to zero. Air
///   that is nearly still takes energy from pitching.
/// quasi_steady: at the highest reduced velocity the derivatives of velocities and rotation tend to what the polar gives by
///   quasi-steady theory (QuasiSteady), those of the rotational rate where their arm is known: from V/(f B) = 20 on in size and
///   sign, below that the sign of those of rotation alone.
[[nodiscard]] const std::vector<std::string>& law_names();

/// @param arms  of the quasi-steady rotational rate; 0 if unknown
/// @return the laws that are broken, each once, in the order of law_names()
[[nodiscard]] std::vector<BrokenLaw> broken_laws(const Polar& polar, const DerivativeTable& table,
                                                 const QuasiSteady::Arms& arms);
/// Those of a polar that has no flutter derivatives beside it.
[[nodiscard]] std::vector<BrokenLaw> broken_laws(const Polar& polar);

}  // namespace twindeck::aero
