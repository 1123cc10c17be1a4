#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"
#include "fe/elements.hpp"
#include "fe/parametric_system.hpp"
#include "io/csv.hpp"
#include "model_io/inp_profiles.hpp"
#include "model_io/inp_writer.hpp"

namespace twindeck::model_io {

using io::format_number;

namespace {

std::string triple(const Eigen::Vector3d& v) {
  return fmt::format("{}, {}, {}", format_number(v.x()), format_number(v.y()), format_number(v.z()));
}

/// Poisson's ratio that makes the shear modulus right; the material's own where none does.
double poisson_of(const fe::Material& m) {
  const double from_moduli = m.youngs_modulus_Pa / (2.0 * m.shear_modulus_Pa) - 1.0;
  return from_moduli > -0.99 && from_moduli < 0.4999 ? from_moduli : m.poisson_ratio;
}

/// A rectangle with the section's radii of gyration, in a material scaled so that EA, EI, the mass and GJ are the section's.
struct EquivalentRectangle {
  double a, b, factor, poisson_ratio;
  bool torsion;  ///< false: no Poisson's ratio gives the torsional stiffness
};
EquivalentRectangle equivalent_rectangle(const fe::Section& s, const fe::Material& m) {
  EquivalentRectangle r{std::sqrt(12.0 * s.inertia_z_m4 / s.area_m2), std::sqrt(12.0 * s.inertia_y_m4 / s.area_m2), 0.0, 0.0,
                        true};
  r.factor = s.area_m2 / (r.a * r.b);
  r.poisson_ratio =
      r.factor * m.youngs_modulus_Pa * rectangle_torsion(r.a, r.b) / (2.0 * m.shear_modulus_Pa * s.torsion_m4) - 1.0;
  if (r.poisson_ratio < -0.9 || r.poisson_ratio > 0.49) {
    r.poisson_ratio = poisson_of(m);
    r.torsion = false;
  }
  return r;
}

}  // namespace

void InpWriter::beam_section(const std::string& set, const fe::Section& s, const fe::Material& m, const Eigen::Vector3d& n1,
                             bool shear) {
  if (flavour_ == InpFlavour::abaqus) {
    // The card takes numbers, not a material; written beside it, its name comes back when the file is read.
    (void)material(m.name, m.youngs_modulus_Pa, poisson_of(m), m.density_kg_m3);
    elements_ += fmt::format("*BEAM GENERAL SECTION, ELSET={}, SECTION=GENERAL, DENSITY={}\n{}, {}, {}, {}, {}\n{}\n{}, {}\n",
                             set, format_number(m.density_kg_m3), format_number(s.area_m2), format_number(s.inertia_y_m4),
                             format_number(s.inertia_yz_m4), format_number(s.inertia_z_m4), format_number(s.torsion_m4),
                             triple(n1), format_number(m.youngs_modulus_Pa), format_number(m.shear_modulus_Pa));
    if (shear) {
      elements_ += fmt::format("*TRANSVERSE SHEAR STIFFNESS\n{}, {}\n", format_number(m.shear_modulus_Pa * s.shear_area_z_m2),
                               format_number(m.shear_modulus_Pa * s.shear_area_y_m2));
    }
    return;
  }
  if (const auto profile = recognise_profile(s)) {
    std::string values;
    for (const double v : profile->values) values += (values.empty() ? "" : ", ") + format_number(v);
    if (profile->name == "CIRC") values = fmt::format("{0}, {0}", format_number(2.0 * profile->values[0]));  // diameters
    elements_ +=
        fmt::format("*BEAM SECTION, ELSET={}, MATERIAL={}, SECTION={}\n{}\n{}\n", set,
                    material(m.name, m.youngs_modulus_Pa, poisson_of(m), m.density_kg_m3), profile->name, values, triple(n1));
    return;
  }
  const EquivalentRectangle r = equivalent_rectangle(s, m);
  note(fmt::format(
      "section '{}' is written as the rectangle of its radii of gyration, in a material scaled to its stiffness and mass{}",
      s.name, r.torsion ? "" : "; its torsional stiffness is not kept"));
  if (s.inertia_yz_m4 != 0.0) note(fmt::format("the product of inertia of section '{}' is left out", s.name));
  elements_ += fmt::format("*BEAM SECTION, ELSET={}, MATERIAL={}, SECTION=RECT\n{}, {}\n{}\n", set,
                           material(s.name, r.factor * m.youngs_modulus_Pa, r.poisson_ratio, r.factor * m.density_kg_m3),
                           format_number(r.a), format_number(r.b), triple(n1));
}

void InpWriter::beams_and_bars() {
  struct Group {
    const fe::Element* first;
    Eigen::Vector3d n1;
    std::vector<std::pair<long, std::vector<long>>> rows;
  };
  std::map<std::string, Group> groups;
  std::map<std::string, long> ends;  // nodes at the ends of offsets
  for (std::size_t i = 0; i < model_.elements.size(); ++i) {
    const fe::Element& e = model_.elements[i];
    if (e.section < 0) continue;
    const fe::Section& s = model_.sections[static_cast<std::size_t>(e.section)];
    const fe::Material& m = model_.materials[static_cast<std::size_t>(e.material)];
    const auto wish = e.group.empty() ? s.name : e.group;
    if (e.type == fe::ElementType::bar || e.type == fe::ElementType::stay) {
      double modulus = m.youngs_modulus_Pa;
      std::string name = m.name;
      const auto pull =
          static_cast<std::size_t>(state_.stay_pull_N.size()) > i ? state_.stay_pull_N[static_cast<Eigen::Index>(i)] : 0.0;
      if (e.type == fe::ElementType::stay) {
        // Half the mass at each end, as in our own matrices; a truss would spread it.
        const Eigen::Vector3d chord =
            model_.nodes[static_cast<std::size_t>(e.nodes[1])].x_m - model_.nodes[static_cast<std::size_t>(e.nodes[0])].x_m;
        for (const int node : e.nodes) point_mass("stay_ends", node, 0.5 * m.density_kg_m3 * s.area_m2 * chord.norm());
      }
      if (e.type == fe::ElementType::stay && pull > 0.0) {
        const Eigen::Vector3d chord =
            model_.nodes[static_cast<std::size_t>(e.nodes[1])].x_m - model_.nodes[static_cast<std::size_t>(e.nodes[0])].x_m;
        modulus =
            fe::Dischinger{m.density_kg_m3 * model_.gravity_m_s2, chord.head<2>().norm(), pull / s.area_m2}.modulus(modulus);
        name = e.name;
        note("stays are trusses with the tangent modulus (Ernst) of their pull");
      }
      const std::string text = fmt::format("{}|T|{}|{}|{}", wish, e.section, name, modulus);
      auto& group = groups.try_emplace(text, Group{&e, {}, {}}).first->second;
      group.n1[0] = modulus;
      group.rows.push_back({e.id, {node_id(e.nodes[0]), node_id(e.nodes[1])}});
      continue;
    }
    if (e.type != fe::ElementType::beam) continue;
    if (e.releases != 0) {
      throw InputError({model_.source, 0, "releases"}, fmt::format("beam {} releases its ends, which is not exported", e.id),
                       "model the hinge by two nodes and springs, or export without that member");
    }
    fe::BeamGeometry geometry;
    geometry.orientation = e.orientation;
    geometry.offset_m = e.offset_m;
    std::vector<long> nodes;
    for (std::size_t end = 0; end < 2; ++end) {
      const fe::Node& node = model_.nodes[static_cast<std::size_t>(e.nodes[end])];
      geometry.node_m[end] = node.x_m;
      nodes.push_back(node.id);
      if (e.offset_m[end].norm() <= 0.0) continue;
      const auto [place, fresh] = ends.emplace(fmt::format("{}|{}", node.id, triple(e.offset_m[end])), 0);
      if (fresh) {
        place->second = add_node(node.x_m + e.offset_m[end]);
        rigid_equations(node.id, node.x_m, place->second, node.x_m + e.offset_m[end], true);
      }
      nodes.back() = place->second;
    }
    const Eigen::Vector3d n1 = fe::beam_axes(geometry).row(1).transpose();
    if (flavour_ == InpFlavour::calculix) {
      const Eigen::Vector3d middle =
          0.5 * (geometry.node_m[0] + geometry.offset_m[0] + geometry.node_m[1] + geometry.offset_m[1]);
      nodes = {nodes[0], add_node(middle), nodes[1]};
    }
    const std::string text = fmt::format("{}|B|{}|{}|{:.9f} {:.9f} {:.9f}", wish, e.section, e.material, n1[0], n1[1], n1[2]);
    groups.try_emplace(text, Group{&e, n1, {}}).first->second.rows.push_back({e.id, nodes});
  }
  for (const auto& [text, group] : groups) {
    const fe::Element& e = *group.first;
    const fe::Section& s = model_.sections[static_cast<std::size_t>(e.section)];
    const fe::Material& m = model_.materials[static_cast<std::size_t>(e.material)];
    const std::string wish = e.group.empty() ? s.name : e.group;
    if (e.type == fe::ElementType::beam) {
      const bool shear = model_.formulation.shear_flexible && s.shear_area_y_m2 > 0.0 && s.shear_area_z_m2 > 0.0;
      const std::string type = flavour_ == InpFlavour::calculix ? "B32R" : (shear ? "B31" : "B33");
      beam_section(element_block(type, wish, group.rows), s, m, group.n1, shear);
    } else {
      const std::string name = e.type == fe::ElementType::stay ? e.name : m.name;
      const std::string set = element_block("T3D2", wish, group.rows);
      elements_ +=
          fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}\n{}\n", set,
                      material(name, group.n1[0], m.poisson_ratio, e.type == fe::ElementType::stay ? 0.0 : m.density_kg_m3),
                      format_number(s.area_m2));
    }
  }
  if (state_.axial_force_N.size() > 0 && model_.prestress.geometric_stiffness && model_.prestress.rule != fe::PullRule::none) {
    note("the geometric stiffness of dead load and pulls is left out: compare with prestress.geometric_stiffness = false");
  }
}

void InpWriter::faces_and_blocks() {
  std::map<std::string, std::pair<const fe::Element*, std::vector<std::pair<long, std::vector<long>>>>> groups;
  for (const fe::Element& e : model_.elements) {
    if (e.type != fe::ElementType::shell && e.type != fe::ElementType::solid) continue;
    std::vector<long> nodes;
    for (const int node : e.nodes) nodes.push_back(node_id(node));
    auto& group = groups[fmt::format("{}|{}|{}|{}", static_cast<int>(e.type), e.group, e.section, e.material)];
    group.first = &e;
    group.second.push_back({e.id, nodes});
  }
  for (const auto& [text, group] : groups) {
    const fe::Element& e = *group.first;
    const fe::Material& m = model_.materials[static_cast<std::size_t>(e.material)];
    const std::string material_name = material(m.name, m.youngs_modulus_Pa, m.poisson_ratio, m.density_kg_m3);
    if (e.type == fe::ElementType::solid) {
      // Incompatible modes in both programs, as in ours.
      const std::string set = element_block("C3D8I", e.group.empty() ? "solid" : e.group, group.second);
      elements_ += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}\n", set, material_name);
      continue;
    }
    const fe::Section& s = model_.sections[static_cast<std::size_t>(e.section)];
    const std::string set = element_block("S4", e.group.empty() ? s.name : e.group, group.second);
    elements_ += fmt::format("*SHELL SECTION, ELSET={}, MATERIAL={}\n{}\n", set, material_name, format_number(s.thickness_m));
    if (s.bending_inertia_ratio != 1.0) {
      note(fmt::format("the bending inertia ratio {} of section '{}' is left out", s.bending_inertia_ratio, s.name));
    }
  }
}

}  // namespace twindeck::model_io
