#include "reliability/annual.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace twindeck::reliability {

double OverSpeed::probability(double speed, double beyond) const {
  double low = 0.0, at_low = 0.0;
  for (std::size_t i = 0; i < speed_m_s.size(); ++i) {
    if (speed <= speed_m_s[i]) return at_low + (value[i] - at_low) * (speed - low) / (speed_m_s[i] - low);
    low = speed_m_s[i];
    at_low = value[i];
  }
  return beyond;
}

double OverSpeed::damage(double speed) const {
  TWINDECK_ASSERT(value.size() >= 2);
  if (speed <= 0.0) return 0.0;
  const auto above = std::upper_bound(speed_m_s.begin(), speed_m_s.end(), speed);
  const auto last = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - speed_m_s.begin(), 1, std::ssize(value) - 1));
  const double low = value[last - 1], high = value[last];
  if (!(low > 0.0 && high > 0.0)) return speed >= speed_m_s[last] ? high : low;
  const double power = std::log(high / low) / std::log(speed_m_s[last] / speed_m_s[last - 1]);
  return low * std::pow(speed / speed_m_s[last - 1], power);
}

}  // namespace twindeck::reliability
