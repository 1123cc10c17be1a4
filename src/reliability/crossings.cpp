#include "reliability/crossings.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::reliability {

double SpectralMoments::mean_rate_Hz() const {
  return variance > 0.0 ? std::sqrt(second / variance) / (2.0 * std::numbers::pi) : 0.0;
}

double SpectralMoments::bandwidth() const {
  return variance > 0.0 && second > 0.0 ? std::sqrt(std::max(0.0, 1.0 - first * first / (variance * second))) : 0.0;
}

SpectralMoments spectral_moments(const Eigen::Ref<const Eigen::VectorXd>& f_Hz,
                                 const Eigen::Ref<const Eigen::VectorXd>& spectrum) {
  TWINDECK_ASSERT(f_Hz.size() == spectrum.size() && f_Hz.size() >= 2);
  SpectralMoments out;
  for (Eigen::Index i = 0; i + 1 < f_Hz.size(); ++i) {
    const double width = 0.5 * (f_Hz[i + 1] - f_Hz[i]);
    for (const Eigen::Index k : {i, i + 1}) {
      const double omega = 2.0 * std::numbers::pi * f_Hz[k], part = width * spectrum[k];
      out.variance += part;
      out.first += part * omega;
      out.second += part * omega * omega;
      out.fourth += part * omega * omega * omega * omega;
    }
  }
  return out;
}

double crossing_rate_Hz(const SpectralMoments& moments, double level) {
  if (!(moments.variance > 0.0)) return 0.0;
  return moments.mean_rate_Hz() * std::exp(-0.5 * level * level / moments.variance);
}

FirstExcursion first_excursion(const SpectralMoments& moments, double level, double duration_s) {
  TWINDECK_ASSERT(level > 0.0 && duration_s >= 0.0);
  FirstExcursion out;
  if (!(moments.variance > 0.0)) return out;
  const double ratio = level / std::sqrt(moments.variance), upward = moments.mean_rate_Hz();
  const double both = 2.0 * upward * std::exp(-0.5 * ratio * ratio);
  out.poisson = -std::expm1(-both * duration_s);
  const double below = -std::expm1(-0.5 * ratio * ratio);  // share of envelopes below the level
  const double width = std::pow(moments.bandwidth(), 1.2);
  const double clumped = -std::expm1(-std::sqrt(0.5 * std::numbers::pi) * width * ratio);
  const double rate = both * clumped / below;
  out.vanmarcke = -std::expm1(std::log(below) - rate * duration_s);
  return out;
}

}  // namespace twindeck::reliability
