#pragma once

#include <Eigen/Core>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "aero/aeroelastic_system.hpp"
#include "core/error.hpp"

namespace twindeck::aero {

/// A free vibration q = Re(vector e^(λt)).
struct ComplexMode {
  std::complex<double> lambda;
  Eigen::VectorXcd vector;  ///< (m) of unit length
  /// Of the oscillation itself.
  [[nodiscard]] double frequency_Hz() const { return lambda.imag() / (2.0 * std::numbers::pi); }
  /// Negative when it grows.
  [[nodiscard]] double damping_ratio() const { return -lambda.real() / std::abs(lambda); }
};

/// Oscillating modes without wind, by |λ|, from the full state-space matrix (dashpots and Maxwell units included).
[[nodiscard]] std::vector<ComplexMode> still_air_modes(const ReducedStructure& structure);

/// One mode, tracked over the wind speed.
struct Branch {
  int mode = 0;           ///< position among still_air_modes, from 1
  ComplexMode still_air;  ///< the mode without wind, before the first of `points`
  std::vector<double> speed_m_s;
  std::vector<ComplexMode> points;
  Status status;  ///< not converged: where the mode was lost (it stopped oscillating, for instance)
};

/// Tracks a mode through ascending speeds by p-K iteration. The forces are those of harmonic motion at Im λ, so the critical
/// speed, where λ is imaginary, is exact. At each speed Newton's iteration solves (λ² + λC + Λ - λCa - Ka) v = 0 from the mode
/// at the speed before, with forces renewed at Im λ. A step that loses the shape (MAC below one half) is halved.
[[nodiscard]] Branch follow_mode(const AeroelasticSystem& system, const ComplexMode& still_air, int mode,
                                 const std::vector<double>& speed_m_s);
/// The mode at one speed, from a mode at a lower one. @return empty if it cannot be tracked
[[nodiscard]] std::optional<ComplexMode> mode_at(const AeroelasticSystem& system, const ComplexMode& from,
                                                 double from_speed_m_s, double speed_m_s);
/// Range of frequencies at which derivatives are taken [rad/s]. Outside the range those of its nearer end are used.
struct FrequencyRange {
  double lowest = 0.0, highest = std::numeric_limits<double>::infinity();
};
/// The mode at one speed, by the same iteration from a motion at that speed. @return empty if it does not converge
[[nodiscard]] std::optional<ComplexMode> mode_near(const AeroelasticSystem& system, const ComplexMode& start, double speed_m_s,
                                                   const FrequencyRange& range);

/// Where a mode's damping passes through zero from above.
struct CriticalPoint {
  int mode = 0;
  double speed_m_s = 0.0, frequency_Hz = 0.0;
  double still_air_frequency_Hz = 0.0;
  ComplexMode motion;
  double bracket_m_s = 0.0;  ///< the critical speed lies at most this far below `speed_m_s`
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
