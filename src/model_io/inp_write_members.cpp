#include <fmt/format.h>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/parametric_system.hpp"
#include "io/csv.hpp"
#include "model_io/inp_expanded_beam.hpp"
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

}  // namespace

void InpWriter::general_section(const std::string& set, const fe::Section& s, const fe::Material& m, const Eigen::Vector3d& n1,
                                bool shear) {
  // The card takes numbers, not a material; written beside it, its name comes back when the file is read.
  (void)material(m.name, m.youngs_modulus_Pa, poisson_of(m), m.density_kg_m3);
  elements_ += fmt::format("*BEAM GENERAL SECTION, ELSET={}, SECTION=GENERAL, DENSITY={}\n{}, {}, {}, {}, {}\n{}\n{}, {}\n",
                           set, format_number(m.density_kg_m3), format_number(s.area_m2), format_number(s.inertia_y_m4),
                           format_number(s.inertia_yz_m4), format_number(s.inertia_z_m4), format_number(s.torsion_m4),
                           triple(n1), format_number(m.youngs_modulus_Pa), format_number(m.shear_modulus_Pa));
  if (shear)
    elements_ += fmt::format("*TRANSVERSE SHEAR STIFFNESS\n{}, {}\n", format_number(m.shear_modulus_Pa * s.shear_area_z_m2),
                             format_number(m.shear_modulus_Pa * s.shear_area_y_m2));
}

void InpWriter::expanded_section(const std::string& set, const fe::Section& s, const fe::Material& m,
                                 const Eigen::Vector3d& axis, const Eigen::Vector3d& n1) {
  const ExpandedBeam beam = expanded_beam(s, m);
  note_expansion(s, beam);
  const std::string axes = set_name("O_beam");
  elements_ += fmt::format("*ORIENTATION, NAME={}, SYSTEM=RECTANGULAR\n{}, {}\n", axes, triple(axis), triple(n1));
  elements_ += fmt::format("*BEAM SECTION, ELSET={}, MATERIAL={}, SECTION={}, ORIENTATION={}\n{}, {}\n{}\n", set,
                           beam_material(beam.profile.name == "PIPE" ? m.name : s.name, beam), beam.profile.name, axes,
                           format_number(beam.profile.values[0]), format_number(beam.profile.values[1]), triple(n1));
}

void InpWriter::note_expansion(const fe::Section& s, const ExpandedBeam& beam) {
  constexpr double said_above = 1.2;  // a factor nearer to 1 is not worth a line
  const auto differs = [](double factor) { return factor > said_above || factor * said_above < 1.0; };
  if (beam.scaled)
    note(fmt::format(
        "section '{}' is written as the rectangle of its radii of gyration, in a material scaled to its stiffness and mass",
        s.name));
  if (differs(beam.torsion[0]) || differs(beam.torsion[1]))
    note(fmt::format("the torsional stiffness of section '{}' is {:.2f} (long elements) to {:.2f} times its own", s.name,
                     beam.torsion[0], beam.torsion[1]));
  if (differs(beam.shear[0]) || differs(beam.shear[1]))
    note(fmt::format("the shear stiffness of section '{}' is {:.2f} and {:.2f} times its own along y and z", s.name,
                     beam.shear[0], beam.shear[1]));
  if (s.inertia_yz_m4 != 0.0) note(fmt::format("the product of inertia of section '{}' is left out", s.name));
  if (!model_.formulation.shear_flexible) note("CalculiX's beams are flexible in shear, this model's are not");
}

void InpWriter::beams() {
  struct Group {
    const fe::Element* first;
    Eigen::Vector3d axis, n1;
    std::vector<std::pair<long, std::vector<long>>> rows;
  };
  std::map<std::string, Group> groups;
  for (const fe::Element& e : model_.elements) {
    if (e.type != fe::ElementType::beam) continue;
    fe::BeamGeometry geometry;
    std::vector<long> nodes = beam_ends(e, geometry);
    const Eigen::Matrix3d axes = fe::beam_axes(geometry);
    std::string text =
        fmt::format("{}|{}|{}|{:.9f} {:.9f} {:.9f}", group_name(e), e.section, e.material, axes(1, 0), axes(1, 1), axes(1, 2));
    if (flavour_ == InpFlavour::calculix) {
      const Eigen::Vector3d middle =
          0.5 * (geometry.node_m[0] + geometry.offset_m[0] + geometry.node_m[1] + geometry.offset_m[1]);
      nodes = {nodes[0], add_node(middle), nodes[1]};
      // The material's axes are the beam's: one card for each direction.
      text += fmt::format("|{:.9f} {:.9f} {:.9f}", axes(0, 0), axes(0, 1), axes(0, 2));
    }
    groups.try_emplace(text, Group{&e, axes.row(0).transpose(), axes.row(1).transpose(), {}})
        .first->second.rows.push_back({e.id, nodes});
  }
  for (const auto& [text, group] : groups) {
    const fe::Section& s = model_.sections[fe::slot(group.first->section)];
    const fe::Material& m = model_.materials[fe::slot(group.first->material)];
    if (flavour_ == InpFlavour::calculix) {
      expanded_section(element_block("B32R", group_name(*group.first), group.rows), s, m, group.axis, group.n1);
      continue;
    }
    const bool shear = model_.formulation.shear_flexible && s.shear_area_y_m2 > 0.0 && s.shear_area_z_m2 > 0.0;
    general_section(element_block(shear ? "B31" : "B33", group_name(*group.first), group.rows), s, m, group.n1, shear);
  }
}

std::vector<long> InpWriter::beam_ends(const fe::Element& e, fe::BeamGeometry& geometry) {
  if (e.releases != 0)
    throw InputError({model_.source, 0, "releases"}, fmt::format("beam {} releases its ends, which is not exported", e.id),
                     "model the hinge by two nodes and springs, or export without that member");
  geometry.orientation = e.orientation;
  geometry.offset_m = e.offset_m;
  std::vector<long> nodes;
  for (std::size_t end = 0; end < 2; ++end) {
    const fe::Node& node = model_.nodes[fe::slot(e.nodes[end])];
    geometry.node_m[end] = node.x_m;
    nodes.push_back(node.id);
    if (e.offset_m[end].norm() <= 0.0) continue;
    const auto [place, fresh] = offset_ends_.emplace(fmt::format("{}|{}", node.id, triple(e.offset_m[end])), 0);
    if (fresh) {
      place->second = add_node(node.x_m + e.offset_m[end]);
      rigid_equations(node.id, node.x_m, place->second, node.x_m + e.offset_m[end], true);
    }
    nodes.back() = place->second;
  }
  return nodes;
}

std::string InpWriter::group_name(const fe::Element& e) const {
  return e.group.empty() ? model_.sections[fe::slot(e.section)].name : e.group;
}

void InpWriter::bars_and_stays() {
  struct Group {
    const fe::Element* first;
    double modulus;
    std::vector<std::pair<long, std::vector<long>>> rows;
  };
  std::map<std::string, Group> groups;
  for (std::size_t i = 0; i < model_.elements.size(); ++i) {
    const fe::Element& e = model_.elements[i];
    if (e.type != fe::ElementType::bar && e.type != fe::ElementType::stay) continue;
    const fe::Section& s = model_.sections[fe::slot(e.section)];
    const fe::Material& m = model_.materials[fe::slot(e.material)];
    double modulus = m.youngs_modulus_Pa;
    std::string name = m.name;
    if (e.type == fe::ElementType::stay) {
      const auto pull =
          static_cast<std::size_t>(state_.stay_pull_N.size()) > i ? state_.stay_pull_N[static_cast<Eigen::Index>(i)] : 0.0;
      const Eigen::Vector3d chord = model_.nodes[fe::slot(e.nodes[1])].x_m - model_.nodes[fe::slot(e.nodes[0])].x_m;
      // Half the mass at each end, as in our own matrices; a truss would spread it.
      for (const int node : e.nodes) point_mass("stay_ends", node, 0.5 * m.density_kg_m3 * s.area_m2 * chord.norm());
      if (pull > 0.0) {
        modulus =
            fe::Dischinger{m.density_kg_m3 * model_.gravity_m_s2, chord.head<2>().norm(), pull / s.area_m2}.modulus(modulus);
        name = e.name;
        note("stays are trusses with the tangent modulus (Ernst) of their pull");
      }
    }
    const std::string text = fmt::format("{}|{}|{}|{}", group_name(e), e.section, name, modulus);
    groups.try_emplace(text, Group{&e, modulus, {}})
        .first->second.rows.push_back({e.id, {node_id(e.nodes[0]), node_id(e.nodes[1])}});
  }
  for (const auto& [text, group] : groups) {
    const fe::Element& e = *group.first;
    const fe::Material& m = model_.materials[fe::slot(e.material)];
    const bool stay = e.type == fe::ElementType::stay;
    const std::string set = element_block("T3D2", group_name(e), group.rows);
    elements_ += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}\n{}\n", set,
                             material(stay ? e.name : m.name, group.modulus, m.poisson_ratio, stay ? 0.0 : m.density_kg_m3),
                             format_number(model_.sections[fe::slot(e.section)].area_m2));
  }
}

void InpWriter::members() {
  bars_and_stays();
  beams();
  if (state_.axial_force_N.size() > 0 && model_.prestress.geometric_stiffness && model_.prestress.rule != fe::PullRule::none)
    note("the geometric stiffness of dead load and pulls is left out: compare with prestress.geometric_stiffness = false");
}

void InpWriter::faces_and_blocks() {
  std::map<std::string, std::pair<const fe::Element*, std::vector<std::pair<long, std::vector<long>>>>> groups;
  for (const fe::Element& e : model_.elements) {
    if (e.type != fe::ElementType::shell && e.type != fe::ElementType::solid) continue;
    const auto nodes = each_of(e.nodes, [&](int node) { return node_id(node); });
    // The number of nodes is in the key because a block has one element type.
    auto& group =
        groups[fmt::format("{} of {}|{}|{}|{}", static_cast<int>(e.type), e.nodes.size(), e.group, e.section, e.material)];
    group.first = &e;
    group.second.push_back({e.id, nodes});
  }
  for (const auto& [text, group] : groups) {
    const fe::Element& e = *group.first;
    const fe::Material& m = model_.materials[fe::slot(e.material)];
    const std::string material_name = material(m.name, m.youngs_modulus_Pa, m.poisson_ratio, m.density_kg_m3);
    if (e.type == fe::ElementType::solid) {
      // Of eight nodes with incompatible modes in both programs, as in ours.
      const char* type = e.nodes.size() == 4    ? "C3D4"
                         : e.nodes.size() == 8  ? "C3D8I"
                         : e.nodes.size() == 10 ? "C3D10"
                                                : "C3D20";
      const std::string set = element_block(type, e.group.empty() ? "solid" : e.group, group.second);
      elements_ += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}\n", set, material_name);
      continue;
    }
    const fe::Section& s = model_.sections[fe::slot(e.section)];
    const bool triangle = fe::is_triangle(e), thin = fe::shell_properties(model_, e).shear_thickness_ratio == 0.0;
    const char* type = triangle ? "S3" : "S4";
    if (thin && flavour_ == InpFlavour::abaqus) type = triangle ? "STRI3" : "S4R5";
    if (thin && flavour_ == InpFlavour::calculix) note("thin shells are flexible in transverse shear in CalculiX");
    constexpr double digits = 1e-9;  // [-] of a model folder's numbers
    if (!thin && std::abs(s.shear_thickness_ratio - fe::homogeneous_shear_ratio) > digits)
      note(fmt::format("the shear thickness ratio {} of section '{}' is left out: 5/6 stands for it", s.shear_thickness_ratio,
                       s.name));
    if (triangle && flavour_ == InpFlavour::calculix)
      note("three-node shells are S3, of which CalculiX makes linear wedges: they bend too stiffly there");
    const std::string set = element_block(type, e.group.empty() ? s.name : e.group, group.second);
    elements_ += fmt::format("*SHELL SECTION, ELSET={}, MATERIAL={}\n{}\n", set, material_name, format_number(s.thickness_m));
    if (s.bending_inertia_ratio != 1.0)
      note(fmt::format("the bending inertia ratio {} of section '{}' is left out", s.bending_inertia_ratio, s.name));
  }
}

}  // namespace twindeck::model_io
