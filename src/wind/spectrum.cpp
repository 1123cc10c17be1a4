#include "wind/spectrum.hpp"

#include <cmath>

namespace twindeck::wind {

double von_karman_spectrum(Component component, double f_Hz, double sigma, double length_m, double speed_m_s) {
  const double over_f = length_m / speed_m_s;  // n / f, so that f = 0 is no division by zero
  const double n = f_Hz * over_f;
  if (component == Component::along) return sigma * sigma * 4.0 * over_f / std::pow(1.0 + 70.8 * n * n, 5.0 / 6.0);
  return sigma * sigma * 4.0 * over_f * (1.0 + 755.2 * n * n) / std::pow(1.0 + 283.2 * n * n, 11.0 / 6.0);
}

}  // namespace twindeck::wind
