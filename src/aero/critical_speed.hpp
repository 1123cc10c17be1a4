#pragma once

#include <optional>
#include <string>

#include "aero/follow_mode.hpp"

namespace twindeck::aero {

/// Where a mode's damping passes through zero from above.
struct CriticalPoint {
  int mode = 0;
  double speed_m_s = 0.0, frequency_Hz = 0.0;
  double still_air_frequency_Hz = 0.0;
  ComplexMode motion;
  double bracket_m_s = 0.0;  ///< the damping may be lost so much below `speed_m_s`
};
/// [-] of the speed, to which a critical speed is refined.
inline constexpr double relative_bracket = 1e-10;
/// First loss of damping along a branch, from still air on, refined to `relative_bracket` where the mode can be followed. A
/// mode without damping in still air that grows at the first speed is unstable from there on. Empty if damping stays positive.
[[nodiscard]] std::optional<CriticalPoint> critical_point(const AeroelasticSystem& system, const Branch& branch);

/// Data that explain a critical speed (by yaw rule): location of the vertical motion of the mode, growth of its lift damping.
struct GallopingCharacter {
  std::string deck;            ///< with the larger sum of z² L
  double theta_rms_rad = 0.0;  ///< yaw on that deck, weighted with z² L
  double deck_share = 0.0;     ///< of that deck in the sum of z² L
  double exponent = 0.0;       ///< p = d ln|h1*| / d ln V*, of the sum over strips, at the critical point
};
[[nodiscard]] GallopingCharacter galloping_character(const AeroelasticSystem& system, const ComplexMode& motion,
                                                     double speed_m_s);

/// Speed of static divergence, |Λ - V² S| = 0: the lowest, or empty if there is none.
[[nodiscard]] std::optional<double> divergence_speed(const AeroelasticSystem& system);

/// Den Hartog's criterion on one coordinate by quasi-steady theory, with h1 = C_L' + C_D:
///   V = 4 ω ξ / (-ρ sum B h1 z² L); empty where the sum does not excite.
[[nodiscard]] std::optional<double> den_hartog_speed(const AeroelasticSystem& system, Eigen::Index coordinate);

}  // namespace twindeck::aero
