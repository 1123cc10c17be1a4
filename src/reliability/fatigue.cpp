#include "reliability/fatigue.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

namespace twindeck::reliability {

namespace {

/// Cycles at the category's range (EN 1993-1-11, 9.2).
constexpr double kCategoryCycles = 2e6;
/// Ranges above this many standard deviations hold less than 1e-12 of any damage.
constexpr double kLargestRange = 20.0;

/// Mean damage of a cycle whose range has this density.
template <typename Density>
double mean_damage(const SpectralMoments& moments, const FatigueCurve& curve, const Density& density) {
  const auto each = [&](double range) { return density(range) * curve.damage(range); };
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  const double end = kLargestRange * std::sqrt(moments.variance), knee = std::min(curve.category_Pa, end);
  return Rule::integrate(each, 0.0, knee, 12, 1e-9) + (knee < end ? Rule::integrate(each, knee, end, 12, 1e-9) : 0.0);
}

}  // namespace

double FatigueCurve::damage(double range_Pa) const {
  const double ratio = range_Pa / category_Pa;
  return std::pow(ratio, ratio >= 1.0 ? slope_above : slope_below) / kCategoryCycles;
}

double dirlik_density(const SpectralMoments& moments, double range) {
  const double l0 = moments.variance, l1 = moments.first, l2 = moments.second, l4 = moments.fourth;
  if (!(l0 > 0.0 && l2 > 0.0 && l4 > 0.0)) return 0.0;
  const double mean_frequency = l1 / l0 * std::sqrt(l2 / l4), irregularity = l2 / std::sqrt(l0 * l4);
  const double d1 = 2.0 * (mean_frequency - irregularity * irregularity) / (1.0 + irregularity * irregularity);
  const double r = (irregularity - mean_frequency - d1 * d1) / (1.0 - irregularity - d1 + d1 * d1);
  const double d2 = (1.0 - irregularity - d1 + d1 * d1) / (1.0 - r), d3 = 1.0 - d1 - d2;
  const double q = 1.25 * (irregularity - d3 - d2 * r) / d1;
  const double half = 2.0 * std::sqrt(l0), z = range / half;
  double density = d3 * z * std::exp(-0.5 * z * z);
  if (d1 > 0.0 && q > 0.0) density += d1 / q * std::exp(-z / q);
  if (r != 0.0 && std::isfinite(r)) density += d2 * z / (r * r) * std::exp(-0.5 * z * z / (r * r));
  return density / half;
}

double damage_rate_Hz(const SpectralMoments& moments, const FatigueCurve& curve) {
  if (!(moments.variance > 0.0 && moments.second > 0.0)) return 0.0;
  const double peaks = std::sqrt(moments.fourth / moments.second) / (2.0 * std::numbers::pi);
  return peaks * mean_damage(moments, curve, [&](double range) { return dirlik_density(moments, range); });
}

double narrow_band_damage_rate_Hz(const SpectralMoments& moments, const FatigueCurve& curve) {
  if (!(moments.variance > 0.0 && moments.second > 0.0)) return 0.0;
  const double quarter = 1.0 / (4.0 * moments.variance);  // range = 2 amplitudes
  return moments.mean_rate_Hz() *
         mean_damage(moments, curve, [&](double range) { return quarter * range * std::exp(-0.5 * quarter * range * range); });
}

}  // namespace twindeck::reliability
