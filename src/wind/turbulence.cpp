#include "wind/turbulence.hpp"

#include <algorithm>
#include <cmath>

namespace twindeck::wind {
namespace {

double effective_height(const TurbulenceSet& set, double z_m) { return std::max(z_m, set.minimum_height_m); }

}  // namespace

double standard_deviation(const TurbulenceSet& set, Component component, double z_m, double mean_speed_m_s) {
  const double intensity = 1.0 / std::log(effective_height(set, z_m) / set.roughness_m);
  return of(set.sigma_ratio, component) * intensity * mean_speed_m_s;
}

double length_scale(const TurbulenceSet& set, Component component, double z_m) {
  return of(set.scale_ratio, component) * 300.0 * std::pow(effective_height(set, z_m) / 200.0, set.kappa);
}

}  // namespace twindeck::wind
