#include "reliability/corrosion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/error.hpp"

namespace twindeck::reliability {

namespace {

/// Years to which the power law is measured (ISO 9224:2012, 6).
constexpr double kPowerLawYears = 20.0;

[[noreturn]] void eaten(double thickness_m, double loss_m) {
  throw InputError(
      {"", 0, "corrosion"},
      fmt::format("takes {:.2f} mm of a wall of {:.2f} mm, and nothing is left of it", 1e3 * loss_m, 1e3 * thickness_m),
      "end the years before that, give the coating's life, or choose the category of the place");
}

}  // namespace

double Corrosion::loss_m(double years) const {
  const double exposed = std::max(0.0, years - coating_life_years);
  if (exposed <= kPowerLawYears) return first_year_m * std::pow(exposed, exponent);
  return first_year_m * (std::pow(kPowerLawYears, exponent) +
                         exponent * std::pow(kPowerLawYears, exponent - 1.0) * (exposed - kPowerLawYears));
}

double Corrosion::years_until(double loss_m) const {
  const double power = std::pow(kPowerLawYears, exponent) * first_year_m;
  if (loss_m <= power) return coating_life_years + std::pow(loss_m / first_year_m, 1.0 / exponent);
  return coating_life_years + kPowerLawYears + (loss_m - power) * kPowerLawYears / (exponent * power);
}

std::optional<double> first_year_loss_m(const std::string& category) {
  static const std::map<std::string, double> middle_um = {{"C1", 0.65}, {"C2", 13.15}, {"C3", 37.5},
                                                          {"C4", 65.0}, {"C5", 140.0}, {"CX", 450.0}};
  const auto at = middle_um.find(category);
  return at == middle_um.end() ? std::nullopt : std::optional<double>(1e-6 * at->second);
}

double remaining_share(double thickness_m, double loss_m, int exposed_sides) {
  const double lost = loss_m * exposed_sides;
  if (!(lost < thickness_m)) eaten(thickness_m, lost);
  return 1.0 - lost / thickness_m;
}

double remaining_round_share(double diameter_m, double loss_m) {
  if (!(2.0 * loss_m < diameter_m)) eaten(diameter_m, 2.0 * loss_m);
  const double share = 1.0 - 2.0 * loss_m / diameter_m;
  return share * share;
}

}  // namespace twindeck::reliability
