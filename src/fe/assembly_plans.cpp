#include "fe/assembly_plans.hpp"

#include <fmt/format.h>

#include "fe/assembly_elements.hpp"
#include "fe/matrix_element.hpp"

namespace twindeck::fe {

namespace {

constexpr std::uint16_t axial_releases = (1U << 0) | (1U << 6);

ElementMatrix beam_with(const Element& e, const BeamGeometry& geometry, const TaperedProperties& ends) {
  return {six_per_node(e), e.section2 >= 0 ? tapered_beam_stiffness(geometry, ends) : beam_stiffness(geometry, ends.end1)};
}

ElementMatrix beam_whole(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return beam_with(e, beam_geometry(model, e), beam_end_properties(model, e));
}

/// Stiffness along the beam's axis alone; releases of the other directions do not touch it.
ElementMatrix beam_axial(const Model& model, int i) {
  const Element& e = element_at(model, i);
  BeamGeometry geometry = beam_geometry(model, e);
  geometry.releases &= axial_releases;
  TaperedProperties ends = beam_end_properties(model, e);
  for (BeamStiffnessProperties* p : {&ends.end1, &ends.end2})
    *p = {p->youngs_modulus_Pa, p->shear_modulus_Pa, p->area_m2, 0, 0, 0, 0, 0, 0};
  return beam_with(e, geometry, ends);
}

/// A beam without its area: nothing is left along its axis.
std::pair<BeamGeometry, TaperedProperties> without_area(const Model& model, const Element& e) {
  BeamGeometry geometry = beam_geometry(model, e);
  geometry.releases &= static_cast<std::uint16_t>(~axial_releases);
  TaperedProperties ends = beam_end_properties(model, e);
  ends.end1.area_m2 = ends.end2.area_m2 = 0.0;
  return {geometry, ends};
}

/// The rest: bending, shear and torsion.
ElementMatrix beam_transverse(const Model& model, int i) {
  const auto [geometry, ends] = without_area(model, element_at(model, i));
  return beam_with(element_at(model, i), geometry, ends);
}

ElementMatrix bar_axial(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return {three_per_node(e),
          bar_stiffness(end_nodes(model, e), material_of(model, e).youngs_modulus_Pa, section_of(model, e).area_m2)};
}

template <std::uint8_t straight_sides>
ElementMatrix membrane(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return {six_per_node(e), shell_membrane_of(model, e, straight_sides)};
}

/// By the sides that a triangle shares with four-node shells (sides_beside_four_nodes); the first for all other shells.
constexpr std::array membranes = {membrane<0>, membrane<1>, membrane<2>, membrane<3>,
                                  membrane<4>, membrane<5>, membrane<6>, membrane<7>};

ElementMatrix bending(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return {six_per_node(e), shell_bending_of(model, e)};
}

ElementMatrix transverse_shear(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return {six_per_node(e), shell_shear_of(model, e)};
}

ElementMatrix curvature(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return {six_per_node(e), shell_bending_of(model, e) - shell_shear_of(model, e)};
}

ElementMatrix solid(const Model& model, int i) {
  const Element& e = element_at(model, i);
  return {three_per_node(e), solid_stiffness_of(model, e)};
}

ElementMatrix matrix_element_stiffness(const Model& model, int i) {
  return conservative_part(model.matrix_elements[static_cast<std::size_t>(i)]).stiffness;
}

ElementMatrix spring(const Model& model, int i) { return spring_stiffness(model.springs[static_cast<std::size_t>(i)]); }

ElementMatrix whole(const Model& model, int i) { return element_mass(model, element_at(model, i)); }

/// Part of a beam's mass that does not go with its area: the inertia of the section about its own axes.
ElementMatrix beam_rotary(const Model& model, int i) {
  const auto [geometry, ends] = without_area(model, element_at(model, i));
  return beam_mass_of(model, element_at(model, i), geometry, ends);
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

std::vector<TermPlan> plan_stiffness(const Model& model) {
  TermGroups groups;
  const std::vector<std::uint8_t> straight_sides = sides_beside_four_nodes(model);
  for (int i = 0; i < static_cast<int>(model.elements.size()); ++i) {
    const Element& e = element_at(model, i);
    if (e.type == ElementType::stay) continue;
    const std::string of = " of " + material_of(model, e).name;
    if (e.type == ElementType::solid) {
      groups.add_element(model, i, e.group + of + " solids", {.modulus = 1}, solid);
      continue;
    }
    const std::string& section = section_of(model, e).name;
    if (e.type == ElementType::shell) {
      const std::uint8_t sides = straight_sides[slot(i)];
      const std::string beside = sides == 0 ? "" : fmt::format(" beside four-node shells ({})", sides);
      groups.add_element(model, i, section + of + " membrane" + beside, {.modulus = 1, .thickness = 1}, membranes[sides]);
      // Two terms where a shell is flexible in shear: exact at the model's own values, and to first order about them.
      const bool shears = shell_properties(model, e).shear_thickness_ratio > 0.0;
      groups.add_element(model, i, section + of + " bending", {.modulus = 1, .thickness = 3, .ratio = 1},
                         shears ? curvature : bending);
      if (shears)
        groups.add_element(model, i, section + of + " transverse shear", {.modulus = 1, .thickness = 1}, transverse_shear);
    } else if (e.type == ElementType::bar) {
      groups.add_element(model, i, e.group + of + " bars " + section, {.modulus = 1, .area = 1}, bar_axial);
    } else if (is_parameter(model, Target::area, section)) {
      groups.add_element(model, i, e.group + of + " axial " + section, {.modulus = 1, .area = 1}, beam_axial);
      groups.add_element(model, i, e.group + of + " transverse " + section, {.modulus = 1}, beam_transverse);
    } else {
      groups.add_element(model, i, e.group + of, {.modulus = 1}, beam_whole);
    }
  }
  for (int i = 0; i < static_cast<int>(model.springs.size()); ++i) {
    const Spring& s = model.springs[static_cast<std::size_t>(i)];
    if (!carries_stiffness(s)) continue;
    TermPlan& term = groups.add("springs " + s.group, i, spring);
    if (term.parts.size() == 1) add_factor(model, Target::spring_stiffness, s.group, 1.0, term.coefficient);
  }
  for (int i = 0; i < static_cast<int>(model.matrix_elements.size()); ++i)
    groups.add("matrix elements", i, matrix_element_stiffness);
  return groups.take();
}

std::vector<TermPlan> plan_stays(const Model& model, const Eigen::VectorXd& stay_pull_N) {
  std::vector<TermPlan> plans;
  for (int i = 0; i < static_cast<int>(model.elements.size()); ++i) {
    const Element& e = element_at(model, i);
    if (e.type != ElementType::stay) continue;
    TermPlan term{"stay " + e.name, {}, {i}, bar_axial, true};
    const double pull = stay_pull_N.size() > 0 ? stay_pull_N[i] : 0.0;
    if (pull > 0.0) {
      const double E = material_of(model, e).youngs_modulus_Pa;
      term.coefficient.stay = stay_modulus(model, e, pull);
      term.coefficient.base = term.coefficient.stay->law.modulus(E) / E;  // the matrix holds E A / L, the term E_eq A / L
    } else {
      add_factor(model, Target::youngs_modulus, material_of(model, e).name, 1.0, term.coefficient);
    }
    add_factor(model, Target::area, section_of(model, e).name, 1.0, term.coefficient);
    plans.push_back(std::move(term));
  }
  return plans;
}

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
