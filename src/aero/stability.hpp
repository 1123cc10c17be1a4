#pragma once

#include <limits>
#include <optional>
#include <string>

#include "aero/follow_mode.hpp"

namespace twindeck::aero {

/// A motion that the wind makes grow.
struct Growth {
  ComplexMode motion;
  int still_air_mode = 0;         ///< the mode without wind whose shape is the nearest, counted as in Branch; 0: there is none
  bool at_own_frequency = false;  ///< found with derivatives of its own frequency, because nothing grows with frozen ones
  /// "mode 1 grows at 0.599 Hz, damping ratio -0.84 %".
  [[nodiscard]] std::string in_words() const;
};

/// Where derivatives are taken [rad/s].
struct DerivativeFrequencies {
  double frozen_omega = 0.0;        ///< of equations in time
  FrequencyRange own = {0.0, 0.0};  ///< modes in here are also held against derivatives of their own frequency
  /// Growth of a motion above this frequency, where the frozen derivatives say nothing, counts if the motion also grows with
  /// derivatives of its own frequency.
  double frozen_to = std::numeric_limits<double>::infinity();
};

/// The motion that grows fastest at a wind speed, of the equations with frozen derivatives; if none grows there, with
/// derivatives of each mode's own frequency. A motion above `frozen_to` that grows, and whose iteration with derivatives of
/// its own frequency finds no mode, counts. Such a system has no stationary response, so neither an RMS nor a spectrum.
/// @return empty for a stable system
[[nodiscard]] std::optional<Growth> find_growth(const AeroelasticSystem& system, double speed_m_s,
                                                const DerivativeFrequencies& frequencies);

}  // namespace twindeck::aero
