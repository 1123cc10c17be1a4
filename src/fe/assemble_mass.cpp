#include "fe/assemble_mass.hpp"

#include "fe/matrix_element.hpp"

namespace twindeck::fe {

namespace {

ElementMatrix whole(const Model& model, int i) { return element_mass(model, element_at(model, i)); }

/// Part of a beam's mass that does not go with its area: the inertia of the section about its own axes.
ElementMatrix beam_rotary(const Model& model, int i) {
  const Element& e = element_at(model, i);
  TaperedProperties ends = beam_end_properties(model, e);
  ends.end1.area_m2 = ends.end2.area_m2 = 0.0;
  BeamGeometry geometry = beam_geometry(model, e);
  geometry.releases &= static_cast<std::uint16_t>(~((1U << 0) | (1U << 6)));  // nothing is left along the axis
  return beam_mass_of(model, e, geometry, ends);
}

ElementMatrix beam_translational(const Model& model, int i) {
  ElementMatrix m = whole(model, i);
  m.matrix -= beam_rotary(model, i).matrix;
  return m;
}

ElementMatrix shell_translational(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return shell_mass_of(model, e, material_of(model, e).density_kg_m3 * section_of(model, e).thickness_m, 0.0);
}

ElementMatrix shell_rotary(const Model& model, int i) {
  const Element& e = element_at(model, i);
  const double t = section_of(model, e).thickness_m;
  return shell_mass_of(model, e, 0.0, material_of(model, e).density_kg_m3 * t * t * t / 12.0);
}

ElementMatrix matrix_element_mass(const Model& model, int i) {
  return conservative_part(model.matrix_elements[static_cast<std::size_t>(i)]).mass;
}

ElementMatrix mass_at_node(const Model& model, int i) { return point_mass(model.masses[static_cast<std::size_t>(i)]); }

}  // namespace

std::vector<TermPlan> plan_mass(const Model& model) {
  TermGroups groups;
  for (int i = 0; i < static_cast<int>(model.elements.size()); ++i) {
    const Element& e = element_at(model, i);
    const std::string of = " of " + material_of(model, e).name;
    if (e.type == ElementType::solid) {
      groups.add_element(model, i, e.group + of + " solid mass", {.density = 1}, whole);
      continue;
    }
    const std::string& section = section_of(model, e).name;
    if (e.type == ElementType::shell) {
      groups.add_element(model, i, section + of + " mass", {.density = 1, .thickness = 1}, shell_translational);
      if (model.formulation.shell_rotary_inertia)
        groups.add_element(model, i, section + of + " rotary mass", {.density = 1, .thickness = 3}, shell_rotary);
    } else if (e.type != ElementType::beam) {
      groups.add_element(model, i, e.group + of + " mass " + section, {.density = 1, .area = 1}, whole);
    } else if (is_parameter(model, Target::area, section)) {
      groups.add_element(model, i, e.group + of + " beam mass " + section, {.density = 1, .area = 1}, beam_translational);
      groups.add_element(model, i, e.group + of + " rotary mass " + section, {.density = 1}, beam_rotary);
    } else {
      groups.add_element(model, i, e.group + of + " beam mass", {.density = 1}, whole);
    }
  }
  for (int i = 0; i < static_cast<int>(model.masses.size()); ++i) {
    const PointMass& mass = model.masses[static_cast<std::size_t>(i)];
    TermPlan& term = groups.add("point masses " + mass.group, i, mass_at_node);
    if (term.parts.size() == 1) add_factor(model, Target::point_mass, mass.group, 1.0, term.coefficient);
  }
  for (int i = 0; i < static_cast<int>(model.matrix_elements.size()); ++i)
    groups.add("matrix elements", i, matrix_element_mass);
  return groups.take();
}

}  // namespace twindeck::fe
