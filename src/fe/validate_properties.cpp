#include "fe/validate_properties.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "fe/validate_parts.hpp"

namespace twindeck::fe {

namespace {

void require_positive(const Model& model, const std::string& part, const std::string& what, double value,
                      const std::string& unit) {
  if (value > 0.0 && std::isfinite(value)) return;
  refuse(model, part, fmt::format("{} is {:g} {}, expected a positive number", what, value, unit),
         "give it as a positive number");
}

void check_beam_section(const Model& model, const Section& s, const std::string& part) {
  require_positive(model, part, "area", s.area_m2, "m2");
  require_positive(model, part, "inertia_y", s.inertia_y_m4, "m4");
  require_positive(model, part, "inertia_z", s.inertia_z_m4, "m4");
  require_positive(model, part, "torsion constant", s.torsion_m4, "m4");
  if (!(s.inertia_yz_m4 * s.inertia_yz_m4 < s.inertia_y_m4 * s.inertia_z_m4))
    refuse(model, part,
           fmt::format("inertia_yz is {:g} m4, larger than sqrt(inertia_y inertia_z) = {:g} m4: no section has that",
                       s.inertia_yz_m4, std::sqrt(s.inertia_y_m4 * s.inertia_z_m4)),
           "check the product of inertia");
  if (!(s.shear_area_y_m2 >= 0.0 && s.shear_area_z_m2 >= 0.0))
    refuse(model, part,
           fmt::format("shear areas are {:g} and {:g} m2, expected 0 or more", s.shear_area_y_m2, s.shear_area_z_m2),
           "give 0 for a section that is rigid in shear");
}

}  // namespace

void validate_properties(const Model& model) {
  for (const Element& e : model.elements) {
    const Material& m = model.materials[static_cast<std::size_t>(e.material)];
    const std::string material = "material '" + m.name + "'";
    require_positive(model, material, "Young's modulus", m.youngs_modulus_Pa, "Pa");
    if (!(m.density_kg_m3 >= 0.0) || !std::isfinite(m.density_kg_m3))
      refuse(model, material, fmt::format("density is {:g} kg/m3, expected 0 or more", m.density_kg_m3), "give a density");
    if (e.type == ElementType::solid) {
      if (!(m.poisson_ratio > -1.0 && m.poisson_ratio < 0.5))
        refuse(model, material, fmt::format("Poisson's ratio is {:g}, expected a value in ]-1, 0.5[", m.poisson_ratio),
               "give 0.2 for concrete, 0.3 for steel");
      continue;
    }
    const Section& s = model.sections[static_cast<std::size_t>(e.section)];
    const std::string section = "section '" + s.name + "'";
    if (e.type != ElementType::shell && s.bending_inertia_ratio != 1.0)
      refuse(model, section,
             fmt::format("bending inertia ratio is {:g}, but element {} is no shell: only a shell's bending has that factor",
                         s.bending_inertia_ratio, e.id),
             "give 1, or change inertia_y and inertia_z");
    switch (e.type) {
      case ElementType::solid:
        break;
      case ElementType::beam:
        require_positive(model, material, "shear modulus", m.shear_modulus_Pa, "Pa");
        check_beam_section(model, s, section);
        if (e.section2 >= 0) {
          const Section& other = model.sections[static_cast<std::size_t>(e.section2)];
          check_beam_section(model, other, "section '" + other.name + "'");
        }
        break;
      case ElementType::bar:
      case ElementType::stay:
        require_positive(model, section, "area", s.area_m2, "m2");
        break;
      case ElementType::shell:
        require_positive(model, section, "thickness", s.thickness_m, "m");
        require_positive(model, section, "bending inertia ratio", s.bending_inertia_ratio, "");
        if (!(m.poisson_ratio >= 0.0 && m.poisson_ratio < 0.5))
          refuse(model, material, fmt::format("Poisson's ratio is {:g}, expected a value in [0, 0.5[", m.poisson_ratio),
                 "give 0.2 for concrete, 0.3 for steel");
        break;
    }
  }
}

}  // namespace twindeck::fe
