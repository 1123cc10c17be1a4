#include "reliability/worn_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::reliability {

double Wall::remaining(const fe::Section& section, double years) const {
  const double loss = corrosion.loss_m(years);
  if (thickness_m > 0.0) return remaining_share(thickness_m, loss, sides);
  if (section.thickness_m > 0.0) return remaining_share(section.thickness_m, loss, sides);
  return remaining_round_share(std::sqrt(4.0 * section.area_m2 / std::numbers::pi), loss);
}

fe::Model worn_model(fe::Model model, const std::vector<Wall>& walls, double years) {
  std::vector<std::string> known;
  for (const fe::Section& section : model.sections) known.push_back(section.name);
  for (const Wall& wall : walls) {
    for (const std::string& name : wall.sections) {
      const auto at = std::find_if(model.sections.begin(), model.sections.end(),
                                   [&](const fe::Section& section) { return section.name == name; });
      if (at == model.sections.end())
        throw InputError({"", 0, "wall.sections"}, "names '" + name + "', which is no section" + did_you_mean(name, known),
                         "choose among the sections of sections.csv");
      const double share = wall.remaining(*at, years), inertia = wall.thickness_m > 0.0 ? share : share * share;
      for (double* value : {&at->area_m2, &at->shear_area_y_m2, &at->shear_area_z_m2, &at->thickness_m}) *value *= share;
      for (double* value : {&at->inertia_y_m4, &at->inertia_z_m4, &at->inertia_yz_m4, &at->torsion_m4}) *value *= inertia;
    }
  }
  return model;
}

fe::Model with_damper_fault(fe::Model model, const std::string& damper, DamperFault fault, double held_stiffness_N_m) {
  const auto at = std::find_if(model.springs.begin(), model.springs.end(), [&](const fe::Spring& spring) {
    return spring.name == damper && spring.group.starts_with("damper");
  });
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

}  // namespace twindeck::reliability
