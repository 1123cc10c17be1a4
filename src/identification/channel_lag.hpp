#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/identification.hpp"

namespace twindeck::identification {

/// Turn of one channel against another in a mode, modulo pi: the sign of a shape is arbitrary.
struct Phase {
  double omega_rad_s = 0.0, angle_rad = 0.0;
  double weight = 0.0;  ///< 1/variance of the angle
};

/// Lag of a channel's clock.
struct Lag {
  double seconds = 0.0, deviation_s = 0.0;
  /// Ten deviations or more (dampers alone cause up to six), and ten degrees or more at the highest mode.
  [[nodiscard]] bool matters(double highest_Hz) const;
};

/// The lag whose phases -omega tau fit those of the modes best (weighted least squares). Phases repeat after half a turn, so
/// several lags may fit; small ones are likelier (Cauchy, its scale a quarter period of the highest mode), and a shape may be
/// turned by a tenth of a radian without a lag. The deviation includes what the lag does not explain.
/// @return none for fewer than two modes
[[nodiscard]] std::optional<Lag> fitted_lag(const std::vector<Phase>& phases);

/// Lag of each channel's clock behind the first one's, from the phases of identified shapes: the modes of a structure move in
/// phase or opposite phase, so a phase that grows with frequency is a lag,
///
///     phase(psi_c) - phase(psi_1) = -2 pi f tau_c   (mod pi).
///
/// Written into `conditioned.quality` (lag_s, lag_std_s); left unknown with fewer than two modes in which the channel takes
/// part.
void estimate_lags(Conditioned& conditioned, const Identification& found);

/// A line that names the channels with a lag that matters: it distorts shapes, and modes may be missing.
/// @param conditioned  with lags estimated @return empty if there is none
[[nodiscard]] std::string lag_warning(const Conditioned& conditioned, const Identification& found);

}  // namespace twindeck::identification
