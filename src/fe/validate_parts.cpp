#include "fe/validate_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "core/lists.hpp"
#include "fe/assembly_parameters.hpp"

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

[[noreturn]] void refuse(const Model& model, const Parameter& p, const std::string& problem, const std::string& mend) {
  throw InputError({model.source, 0, "parameter '" + p.name + "'"}, problem, mend);
}

template <typename List, typename Name>
std::vector<std::string> names_of(const List& list, Name name) {
  std::set<std::string> names;
  for (const auto& part : list) names.insert(part.*name);
  return {names.begin(), names.end()};
}

void check_names(const Model& model, const Parameter& p) {
  if (p.target == Target::matrix_stiffness || p.target == Target::matrix_mass)
    refuse(model, p, "scales a matrix, but this model is made of elements", "scale a material, a section or a group");
  const std::vector<std::string> known = names_of_target(model, p.target);
  if (p.of.empty()) refuse(model, p, "names nothing that it scales", fmt::format("name a {}", kind_of(p.target)));
  for (const std::string& name : p.of)
    if (!contains(known, name))
      refuse(model, p, fmt::format("there is no {} '{}'{}", kind_of(p.target), name, did_you_mean(name, known)),
             fmt::format("known: {}", fmt::join(known, ", ")));
}

void check_unit(const Model& model, const Parameter& p) {
  const std::vector<std::string> known = units_of(p.target);
  if (p.unit.empty() || contains(known, p.unit)) return;
  refuse(model, p, fmt::format("its unit is '{}', expected {}", p.unit, fmt::join(known, " or ")),
         "initial, lower and upper are in SI units, as the model's tables are; - is a factor");
}

void check_values(const Model& model, const Parameter& p, double standing) {
  if (!std::isfinite(p.initial) || p.initial == 0.0 || !std::isfinite(p.lower) || !std::isfinite(p.upper))
    refuse(model, p,
           fmt::format("initial {:g} in [{:g}, {:g}]: expected numbers, the initial one not 0", p.initial, p.lower, p.upper),
           "a parameter scales what it names, so it cannot start at 0");
  if (p.lower > p.initial || p.initial > p.upper)
    refuse(model, p,
           fmt::format("the initial value {:g} {} lies outside its bounds [{:g}, {:g}]", p.initial, p.unit, p.lower, p.upper),
           "widen the bounds or move the initial value");
  if (p.lower <= 0.0 && p.lower < p.upper)
    refuse(model, p, fmt::format("the lower bound is {:g} {}, expected a positive number", p.lower, p.unit),
           "stiffness and mass vanish at 0; raise the bound");
  if (std::abs(p.initial - standing) > 1e-6 * std::abs(standing))  // tables carry 12 digits, people fewer
    refuse(model, p,
           fmt::format("the initial value is {:.9g} {}, but '{}' stands at {:.9g}", p.initial, p.unit, p.of.front(), standing),
           "write the same value in both places");
}

/// An area scales a tapered beam as a whole, so it must name the sections of both ends.
void check_tapers(const Model& model, const Parameter& p) {
  if (p.target != Target::area) return;
  const auto is_named = [&](int section) {
    const std::string& name = model.sections[static_cast<std::size_t>(section)].name;
    return contains(p.of, name);
  };
  for (const Element& e : model.elements)
    if (e.section2 >= 0 && is_named(e.section) != is_named(e.section2))
      refuse(model, p, fmt::format("scales the area at one end of the tapered beam {} alone", e.id),
             "name the sections of both ends");
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
    if (e.type != ElementType::shell && s.shear_thickness_ratio != 0.0)
      refuse(model, section, fmt::format("has a shear thickness ratio, but element {} is no shell", e.id),
             "give 0; beams have shear_area_y and shear_area_z");
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
        if (s.shear_thickness_ratio != 0.0)
          require_positive(model, section, "shear thickness ratio", s.shear_thickness_ratio, "");
        if (!(m.poisson_ratio >= 0.0 && m.poisson_ratio < 0.5))
          refuse(model, material, fmt::format("Poisson's ratio is {:g}, expected a value in [0, 0.5[", m.poisson_ratio),
                 "give 0.2 for concrete, 0.3 for steel");
        break;
    }
  }
}

const char* kind_of(Target target) {
  if (target == Target::youngs_modulus || target == Target::density) return "material";
  if (target == Target::spring_stiffness) return "group of springs";
  return target == Target::point_mass ? "group of point masses" : "section";
}

std::vector<std::string> names_of_target(const Model& model, Target target) {
  if (target == Target::youngs_modulus || target == Target::density) return names_of(model.materials, &Material::name);
  if (target == Target::spring_stiffness) return names_of(model.springs, &Spring::group);
  if (target == Target::point_mass) return names_of(model.masses, &PointMass::group);
  return names_of(model.sections, &Section::name);
}

std::vector<std::string> units_of(Target target) {
  static const std::map<Target, std::vector<std::string>> units = {{Target::youngs_modulus, {"Pa", "N/m2", "N/m^2"}},
                                                                   {Target::density, {"kg/m3", "kg/m^3"}},
                                                                   {Target::thickness, {"m"}},
                                                                   {Target::area, {"m2", "m^2"}}};
  const auto found = units.find(target);
  return found == units.end() ? std::vector<std::string>{"-", "1"} : found->second;
}

void validate_parameters(const Model& model) {
  std::set<std::string> names;
  std::set<std::pair<Target, std::string>> taken;
  const Eigen::VectorXd standing = initial_parameters(model);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const Parameter& p = model.parameters[i];
    if (!names.insert(p.name).second) refuse(model, p, "is defined twice", "give every parameter its own name");
    check_names(model, p);
    for (const std::string& name : p.of)
      if (!taken.insert({p.target, name}).second)
        refuse(model, p, fmt::format("'{}' is scaled by another parameter already", name),
               "let one parameter scale each property");
    check_tapers(model, p);
    check_unit(model, p);
    check_values(model, p, standing[static_cast<Eigen::Index>(i)]);
  }
}

}  // namespace twindeck::fe
