#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace twindeck::sensors {

/// Errors that an accelerometer and its logger add to a motion.
struct LoggerErrors {
  double noise_rms = 0.0;  ///< white, in the whole band up to half the sampling rate [unit of the signal]
  double step = 0.0;       ///< of the converter (one bit); 0: no rounding
  double range = 0.0;      ///< readings are clipped at +-range; 0: no clipping
  double drift =
      0.0;  ///< of the zero over the record: a half wave of this amplitude and a straight line to it, signs at random
};

/// The readings of one channel: motion + zero drift + noise, clipped, rounded to whole steps.
/// @param motion (n_samples) @param seed, stream  fix noise and drift: use a separate stream for each channel of each record
[[nodiscard]] Eigen::VectorXd logged(const Eigen::Ref<const Eigen::VectorXd>& motion, const LoggerErrors& errors,
                                     std::uint64_t seed, std::uint64_t stream);

}  // namespace twindeck::sensors
