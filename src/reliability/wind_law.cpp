#include "reliability/wind_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/error.hpp"

namespace twindeck::reliability {

namespace {

/// EN 1991-1-4:2005, 4.2 (2) note 4: parameters of the probability factor.
constexpr double kCodeK = 0.2, kCodeN = 0.5, kCodeAnnual = 0.98;
/// [-] Share of the time above the last class of a Weibull law.
constexpr double kLeftOut = 1e-12;
/// [-] printed tables are rounded to three digits.
constexpr double kSumTolerance = 1e-3;

}  // namespace

double WindLaw::exceedance(double speed) const {
  switch (kind) {
    case Kind::weibull:
      return speed <= 0.0 ? 1.0 : std::exp(-std::pow(speed / scale_m_s, shape));
    case Kind::table: {
      double sum = 0.0;
      for (std::size_t i = 0; i < speed_m_s.size(); ++i) sum += speed_m_s[i] > speed ? probability[i] : 0.0;
      return sum;
    }
    case Kind::gumbel:
      return -std::expm1(-std::exp(-(speed - mode_m_s) / gumbel_scale_m_s));
    case Kind::code: {
      // c_prob² = (1 - K ln(-ln F)) / (1 - K ln(-ln 0.98)), solved for the annual probability F.
      const double factor = std::pow(speed / (exposure * basic_m_s), 1.0 / kCodeN);
      const double of_basic = 1.0 - kCodeK * std::log(-std::log(kCodeAnnual));
      return -std::expm1(-std::exp((1.0 - factor * of_basic) / kCodeK));
    }
  }
  return 0.0;
}

double WindLaw::average(const std::function<double(double)>& of_speed, double step_m_s) const {
  TWINDECK_ASSERT(step_m_s > 0.0);
  double sum = 0.0;
  if (kind == Kind::table) {
    for (std::size_t i = 0; i < speed_m_s.size(); ++i) sum += probability[i] * of_speed(speed_m_s[i]);
    return sum;
  }
  for (double low = 0.0; exceedance(low) > kLeftOut; low += step_m_s)
    sum += (exceedance(low) - exceedance(low + step_m_s)) * of_speed(low + 0.5 * step_m_s);
  return sum;
}

std::optional<double> roughness_factor(const std::string& terrain, double height_m) {
  struct Terrain {
    double length_m, least_height_m;
  };
  static const std::map<std::string, Terrain> table = {
      {"0", {0.003, 1.0}}, {"I", {0.01, 1.0}}, {"II", {0.05, 2.0}}, {"III", {0.3, 5.0}}, {"IV", {1.0, 10.0}}};
  const auto at = table.find(terrain);
  if (at == table.end()) return std::nullopt;
  const Terrain& of = at->second;
  return 0.19 * std::pow(of.length_m / 0.05, 0.07) * std::log(std::max(height_m, of.least_height_m) / of.length_m);
}

void check_wind_law(const WindLaw& law, const std::string& file) {
  const auto positive = [](double value, const char* key) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError({"", 0, key}, fmt::format("is {}, expected a positive number", value), "");
  };
  using Kind = WindLaw::Kind;
  if (law.kind == Kind::weibull) positive(law.scale_m_s, "wind_law.scale");
  if (law.kind == Kind::weibull) positive(law.shape, "wind_law.shape");
  if (law.kind == Kind::gumbel) positive(law.gumbel_scale_m_s, "wind_law.gumbel_scale");
  if (law.kind == Kind::code) positive(law.basic_m_s, "wind_law.basic_speed");
  if (law.kind == Kind::code) positive(law.exposure, "exposure");
  if (law.kind != Kind::table) return;
  const double sum = std::accumulate(law.probability.begin(), law.probability.end(), 0.0);
  if (std::abs(sum - 1.0) > kSumTolerance)
    throw InputError({file, 0, "probability"}, fmt::format("sums to {:.6g} over all classes, expected 1", sum),
                     "give each class its share of the time; divide all by their sum");
}

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
  const auto above = std::ranges::upper_bound(speed_m_s, speed);
  const auto last = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - speed_m_s.begin(), 1, std::ssize(value) - 1));
  const double low = value[last - 1], high = value[last];
  if (!(low > 0.0 && high > 0.0)) return speed >= speed_m_s[last] ? high : low;
  const double power = std::log(high / low) / std::log(speed_m_s[last] / speed_m_s[last - 1]);
  return low * std::pow(speed / speed_m_s[last - 1], power);
}

}  // namespace twindeck::reliability
