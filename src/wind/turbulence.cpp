#include "wind/turbulence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

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

CoherenceTable::CoherenceTable(Eigen::VectorXd x, Eigen::VectorXd gamma) : x_(std::move(x)), gamma_(std::move(gamma)) {
  TWINDECK_ASSERT(x_.size() >= 2 && x_.size() == gamma_.size() && x_[0] == 0.0 && gamma_[0] == 1.0);
}

double CoherenceTable::at(double x) const {
  if (x > x_[x_.size() - 1]) return 0.0;
  const Eigen::Index i = std::min<Eigen::Index>(std::ranges::upper_bound(x_, x) - x_.begin(), x_.size() - 1);
  const double share = (x - x_[i - 1]) / (x_[i] - x_[i - 1]);
  return (1.0 - share) * gamma_[i - 1] + share * gamma_[i];
}

}  // namespace twindeck::wind
