#include "sensors/logger.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace twindeck::sensors {

Eigen::VectorXd logged(const Eigen::Ref<const Eigen::VectorXd>& motion, const LoggerErrors& errors, std::uint64_t seed,
                       std::uint64_t stream) {
  // Two streams a channel: places 0 and 1 of the second one are the drift's.
  const std::uint64_t noise_stream = 2 * stream, drift_stream = 2 * stream + 1;
  const double line = errors.drift * (2.0 * uniform_number(seed, drift_stream, 0) - 1.0);
  const double wave = errors.drift * (2.0 * uniform_number(seed, drift_stream, 1) - 1.0);
  Eigen::VectorXd out(motion.size());
  for (Eigen::Index t = 0; t < motion.size(); ++t) {
    const double part = static_cast<double>(t) / static_cast<double>(std::max<Eigen::Index>(1, motion.size() - 1));
    double reading = motion[t] + line * part + wave * std::sin(std::numbers::pi * part);
    if (errors.noise_rms > 0.0) reading += errors.noise_rms * normal_number(seed, noise_stream, static_cast<std::uint64_t>(t));
    if (errors.range > 0.0) reading = std::clamp(reading, -errors.range, errors.range);
    out[t] = errors.step > 0.0 ? errors.step * std::round(reading / errors.step) : reading;
  }
  return out;
}

}  // namespace twindeck::sensors
