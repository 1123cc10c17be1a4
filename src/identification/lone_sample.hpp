#pragma once

#include <Eigen/Core>
#include <optional>

namespace twindeck::identification {

/// A sample that no motion explains: an error value of the recorder, a bit that flipped.
struct LoneSample {
  Eigen::Index sample = 0;
  double value = 0.0;
  double deviations = 0.0;  ///< distance from the channel's median in robust standard deviations (1.4826 times the median of
                            ///< absolute distances)
};

/// The sample furthest from the median among those that stand alone: up to three in a row whose neighbours on both sides are
/// within a twentieth of its distance, the first ones as well as the median of ten. What moves a structure does not stand
/// alone: an impact is followed by a free decay, an earthquake lasts, and the filter in front of the converter spreads a pulse
/// over its neighbours.
/// @param x  NaN or infinite where missing
/// @return none where no sample stands alone more than ten robust deviations off
[[nodiscard]] std::optional<LoneSample> lone_sample(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace twindeck::identification
