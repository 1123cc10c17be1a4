#include "reliability/worn_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/lists.hpp"

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

double Wall::remaining(const fe::Section& section, double years) const {
  const double loss = corrosion.loss_m(years);
  if (thickness_m > 0.0) return remaining_share(thickness_m, loss, sides);
  if (section.thickness_m > 0.0) return remaining_share(section.thickness_m, loss, sides);
  return remaining_round_share(std::sqrt(4.0 * section.area_m2 / std::numbers::pi), loss);
}

fe::Model worn_model(fe::Model model, const std::vector<Wall>& walls, double years) {
  for (const Wall& wall : walls) {
    for (const std::string& name : wall.sections) {
      const auto at = std::ranges::find(model.sections, name, &fe::Section::name);
      if (at == model.sections.end())
        throw InputError(
            {"", 0, "wall.sections"},
            "names '" + name + "', which is no section" + did_you_mean(name, each_of(model.sections, &fe::Section::name)),
            "choose among the sections of sections.csv");
      const double share = wall.remaining(*at, years), inertia = wall.thickness_m > 0.0 ? share : share * share;
      for (double* value : {&at->area_m2, &at->shear_area_y_m2, &at->shear_area_z_m2, &at->thickness_m}) *value *= share;
      for (double* value : {&at->inertia_y_m4, &at->inertia_z_m4, &at->inertia_yz_m4, &at->torsion_m4}) *value *= inertia;
    }
  }
  return model;
}

fe::Model with_damper_fault(fe::Model model, const std::string& damper, DamperFault fault, double held_stiffness_N_m) {
  const auto at = std::ranges::find_if(
      model.springs, [&](const fe::Spring& spring) { return spring.name == damper && spring.group.starts_with("damper"); });
  if (at == model.springs.end()) {
    std::vector<std::string> known;
    for (const fe::Spring& spring : model.springs)
      if (spring.group.starts_with("damper")) known.push_back(spring.name);
    throw InputError({"", 0, "fault.damper"}, "names '" + damper + "', which is no damper" + did_you_mean(damper, known),
                     "dampers are the springs of a group that begins with 'damper'");
  }
  if (fault == DamperFault::lost) {
    model.springs.erase(at);
    return model;
  }
  if (!at->series) at->stiffness += held_stiffness_N_m;
  at->series = false;
  at->damping = 0.0;
  return model;
}

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
