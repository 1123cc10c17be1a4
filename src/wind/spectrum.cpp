#include "wind/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace twindeck::wind {

using Eigen::Index;

namespace {

constexpr double kInertialSlope = -5.0 / 3.0;  ///< of ln S over ln n above a table: Kolmogorov's

/// Integral of a power law through (n0, s0) and (n1, s1), given as logarithms, over n0 … n1.
double integral(double log_n0, double log_n1, double log_s0, double log_s1) {
  const double power = (log_s1 - log_s0) / (log_n1 - log_n0) + 1.0, ratio = power * (log_n1 - log_n0);
  const double mean = std::abs(ratio) < 1e-8 ? 1.0 : std::expm1(ratio) / ratio;
  return std::exp(log_s0 + log_n0) * (log_n1 - log_n0) * mean;
}

}  // namespace

double von_karman_spectrum(Component component, double f_Hz, double sigma, double length_m, double speed_m_s) {
  const double over_f = length_m / speed_m_s;  // n / f, so that f = 0 is no division by zero
  const double n = f_Hz * over_f;
  if (component == Component::along) return sigma * sigma * 4.0 * over_f / std::pow(1.0 + 70.8 * n * n, 5.0 / 6.0);
  return sigma * sigma * 4.0 * over_f * (1.0 + 755.2 * n * n) / std::pow(1.0 + 283.2 * n * n, 11.0 / 6.0);
}

SpectrumTable::SpectrumTable(const Eigen::Ref<const Eigen::VectorXd>& n,
                             const Eigen::Ref<const Eigen::VectorXd>& f_s_over_variance)
    : log_n_(n.array().log()), log_density_(f_s_over_variance.array().log() - log_n_.array()) {
  TWINDECK_ASSERT(n.size() >= 2 && n.size() == f_s_over_variance.size());
}

double SpectrumTable::density(double n) const {
  const Index last = log_n_.size() - 1;
  if (n <= 0.0 || std::log(n) <= log_n_[0]) return std::exp(log_density_[0]);
  const double x = std::log(n);
  if (x >= log_n_[last]) return std::exp(log_density_[last] + kInertialSlope * (x - log_n_[last]));
  const Index i = std::ranges::upper_bound(log_n_, x) - log_n_.begin();
  const double share = (x - log_n_[i - 1]) / (log_n_[i] - log_n_[i - 1]);
  return std::exp((1.0 - share) * log_density_[i - 1] + share * log_density_[i]);
}

double SpectrumTable::variance() const {
  const Index last = log_n_.size() - 1;
  double sum = std::exp(log_density_[0] + log_n_[0]) + std::exp(log_density_[last] + log_n_[last]) / (-kInertialSlope - 1.0);
  for (Index i = 1; i <= last; ++i) sum += integral(log_n_[i - 1], log_n_[i], log_density_[i - 1], log_density_[i]);
  return sum;
}

double Spectrum::at(Component component, double f_Hz, double sigma, double length_m, double speed_m_s) const {
  const double over_f = length_m / speed_m_s, n = f_Hz * over_f;
  switch (law) {
    case SpectrumLaw::von_karman:
      break;
    case SpectrumLaw::kaimal:
      return sigma * sigma * 4.0 * over_f / std::pow(1.0 + 6.0 * n, 5.0 / 3.0);
    case SpectrumLaw::en_1991_1_4:
      return sigma * sigma * 6.8 * over_f / std::pow(1.0 + 10.2 * n, 5.0 / 3.0);
    case SpectrumLaw::table:
      return sigma * sigma * over_f * table->density(n);
  }
  return von_karman_spectrum(component, f_Hz, sigma, length_m, speed_m_s);
}

}  // namespace twindeck::wind
