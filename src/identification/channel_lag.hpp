#pragma once

#include <string>

#include "identification/identification.hpp"

namespace twindeck::identification {

/// Lag of each channel's clock behind the first one's, from the phases of identified shapes: the modes of a structure move in
/// phase or opposite phase, so a phase that grows with frequency is a lag,
///
///     phase(psi_c) - phase(psi_1) = -2 pi f tau_c   (mod pi).
///
/// Weighted least squares over the modes on the branch that fits best within ± a quarter period of the highest mode. Written
/// into `conditioned.quality` (lag_s, lag_std_s); left unknown with fewer than two modes in which the channel takes part.
void estimate_lags(Conditioned& conditioned, const Identification& found);

/// A line that names the channels with a significant lag: ten deviations or more (dampers alone cause up to six), and ten
/// degrees or more at the highest mode found. Such a lag distorts shapes, and modes above may be missing.
/// @param conditioned  with lags estimated @return empty if there is none
[[nodiscard]] std::string lag_warning(const Conditioned& conditioned, const Identification& found);

}  // namespace twindeck::identification
