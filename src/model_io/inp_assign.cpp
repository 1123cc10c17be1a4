#include "model_io/inp_assign.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "model_io/inp_attachments.hpp"
#include "model_io/inp_elements.hpp"
#include "model_io/inp_expanded_beam.hpp"
#include "model_io/inp_profiles.hpp"

namespace twindeck::model_io {
namespace {

/// The section of the group's name if it has these numbers, or a new one.
int add_section(InpParts& parts, const InpCard& card, fe::Section section) {
  const InpSet& set = parts.set(parts.element_sets, card, card.line, card.get("ELSET"));
  const auto first = set.members.empty() ? parts.elements.end() : parts.elements.find(set.members.front());
  section.name = first == parts.elements.end() ? set.name : parts.group_set(card, first->second).name;
  return find_or_add_section(parts.model.sections, section);
}

/// The material that the card names, isotropic or a beam's own (InpParts::second_shear_moduli).
int any_material_of(InpParts& parts, const InpCard& card) {
  const std::string name = parts.file.required(card, "MATERIAL");
  const auto found = parts.materials.find(upper_case(name));
  if (found == parts.materials.end()) {
    std::vector<std::string> known;
    for (const auto& m : parts.model.materials) known.push_back(m.name);
    parts.file.fail(card, card.line, fmt::format("material '{}' is not defined{}", name, did_you_mean(name, known)),
                    "define it by *MATERIAL");
  }
  const fe::Material& m = parts.model.materials[static_cast<std::size_t>(found->second)];
  if (m.youngs_modulus_Pa <= 0.0)
    parts.file.fail(card, card.line, fmt::format("material '{}' has no *ELASTIC", name), "give E and nu");
  return found->second;
}

int material_of(InpParts& parts, const InpCard& card) {
  const int material = any_material_of(parts, card);
  if (parts.second_shear_moduli.contains(material)) {
    parts.file.fail(card, card.line, fmt::format("material '{}' is orthotropic, which only beams may be", card.get("MATERIAL")),
                    "give E and nu of an isotropic material");
  }
  return material;
}

const InpLine& data_line(InpParts& parts, const InpCard& card, std::size_t i, const char* what) {
  if (card.data.size() <= i)
    parts.file.fail(card, card.line, fmt::format("data line {} is missing", i + 1), fmt::format("it gives {}", what));
  return card.data[i];
}

double above_zero(InpParts& parts, const InpCard& card, const InpLine& line, std::size_t i) {
  const double value = parts.file.number(card, line, i);
  if (value <= 0.0)
    parts.file.fail(card, line.line, fmt::format("field {} is {}, expected a value above 0", i + 1, value), "SI units");
  return value;
}

void refuse_kind(const InpParts& parts, const InpCard& card, const InpElement& element) {
  parts.refuse_kind(card, element, "such an element takes another section card");
}

fe::Element to_element(InpParts& parts, const InpCard& card, const InpElement& element, fe::ElementType type, int material,
                       int section) {
  if (element.used > 1) {
    parts.file.fail(card, card.line, fmt::format("element {} already has a section", element.id),
                    "take it out of one of the sets");
  }
  fe::Element e;
  e.id = element.id;
  e.type = type;
  e.group = parts.group_of(card, element);
  e.material = material;
  e.section = section;
  for (const long id : element.nodes) e.nodes.push_back(parts.node(*element.card, element.line, id));
  return e;
}

/// Adds a shell or solid, in pieces where it has nodes in the middles of its edges.
void add_whole(InpParts& parts, const fe::Element& whole) {
  const auto new_node = [&](const Eigen::Vector3d& x) {
    const long id = parts.node_position.rbegin()->first + 1;
    parts.node_position.emplace(id, static_cast<int>(parts.model.nodes.size()));
    parts.model.nodes.push_back({id, x});
    return static_cast<int>(parts.model.nodes.size()) - 1;
  };
  const auto new_element = [&] { return ++parts.last_element_id; };
  const std::size_t count = add_in_pieces(parts.model, whole, {new_node, new_element, parts.face_centres});
  if (count > 1) parts.pieces[whole.id] = count;
}

/// A beam, or two through the middle node; our local z is n2 = t × n1, so that local y is n1.
void add_beams(InpParts& parts, const InpCard& card, const Eigen::Vector3d& n1, int material, int section) {
  for (const InpElement* element : parts.elements_of(card)) {
    if (inp_kind(element->type) != InpKind::beam) refuse_kind(parts, card, *element);
    const fe::Element whole = to_element(parts, card, *element, fe::ElementType::beam, material, section);
    for (std::size_t i = 0; i + 1 < whole.nodes.size(); ++i) {
      fe::Element e = whole;
      e.nodes = {whole.nodes[i], whole.nodes[i + 1]};
      const Eigen::Vector3d t = (parts.model.nodes[static_cast<std::size_t>(e.nodes[1])].x_m -
                                 parts.model.nodes[static_cast<std::size_t>(e.nodes[0])].x_m);
      const Eigen::Vector3d n2 = t.cross(n1);
      if (n2.norm() < 1e-6 * t.norm() * n1.norm() || t.norm() == 0.0) {
        parts.file.fail(card, card.line,
                        fmt::format("direction n1 ({}, {}, {}) lies along element {}, or that has no length", n1[0], n1[1],
                                    n1[2], element->id),
                        "give n1 across the beam in the second data line (default 0, 0, -1)");
      }
      e.orientation = n2.normalized();
      if (i > 0) e.id = ++parts.last_element_id;
      parts.model.elements.push_back(e);
    }
    parts.pieces[element->id] = whole.nodes.size() - 1;
  }
}

Eigen::Vector3d first_axis(InpParts& parts, const InpCard& card) {
  Eigen::Vector3d n1(0.0, 0.0, -1.0);
  for (int i = 0; i < 3 && card.data.size() > 1; ++i)
    n1[i] = parts.file.number_or(card, card.data[1], static_cast<std::size_t>(i), 0.0);
  const InpScope& scope = parts.scopes[static_cast<std::size_t>(parts.scope)];
  return scope.turned() ? Eigen::Vector3d(scope.rotation * n1) : n1;
}

/// The two shear moduli of an orthotropic beam hold in its own axes, so that *ORIENTATION has to name them.
void check_orientation(InpParts& parts, const InpCard& card, const fe::Element& e) {
  (void)parts.file.required(card, "ORIENTATION");
  const InpOrientation axes = inp_axes_of(parts, card);
  const Eigen::Vector3d t = (parts.model.nodes[static_cast<std::size_t>(e.nodes[1])].x_m -
                             parts.model.nodes[static_cast<std::size_t>(e.nodes[0])].x_m)
                                .normalized();
  constexpr double aligned = 1.0 - 1e-6;  // 0.08 degrees
  if (std::abs(axes.row(0).dot(t)) < aligned || std::abs(axes.row(2).dot(e.orientation)) < aligned) {
    parts.file.fail(card, card.line,
                    fmt::format("orientation '{}' is not along the axes of element {}", card.get("ORIENTATION"), e.id),
                    "its x' is the beam's axis and its y' the direction n1");
  }
}

/// Whether the card's elements are B33, Euler's beam, which is rigid in shear.
bool is_euler_beam(InpParts& parts, const InpCard& card) {
  const InpSet& set = parts.set(parts.element_sets, card, card.line, card.get("ELSET"));
  std::size_t euler = 0;
  for (const long id : set.members) {
    const auto element = parts.elements.find(id);
    if (element != parts.elements.end() && element->second.type == "B33") ++euler;
  }
  if (euler > 0 && euler < set.members.size())
    parts.file.fail(card, card.line, "its set mixes B33, which is rigid in shear, with other beams",
                    "give the B33 a set and a section of their own");
  return euler > 0;
}

void assign_beam(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"ELSET", "MATERIAL", "SECTION", "POISSON", "TEMPERATURE", "ORIENTATION"});
  std::string profile = upper_case(parts.file.required(card, "SECTION"));
  if (profile == "RECTANGULAR" || profile == "CIRCULAR") profile.resize(4);  // "RECT", "CIRC"
  const std::size_t size = profile_size(profile);
  if (size == 0) {
    parts.file.fail(card, card.line, fmt::format("unsupported SECTION={}{}", profile, did_you_mean(profile, profile_names())),
                    "supported are BOX, CIRC, I, PIPE, RECT, and GENERAL on *BEAM GENERAL SECTION");
  }
  const int material = any_material_of(parts, card);
  const auto second = parts.second_shear_moduli.find(material);
  const InpLine& line = data_line(parts, card, 0, "the dimensions");
  std::vector<double> values;
  for (std::size_t i = 0; i < size; ++i) values.push_back(parts.file.number(card, line, i));
  if (profile == "CIRC" && line.fields.size() > 1) {
    // Abaqus gives the radius; CalculiX both diameters, of an ellipse if they differ.
    if (parts.file.number(card, line, 1) != values[0])
      parts.file.fail(card, line.line, "an ellipse is not supported", "give a circle");
    values[0] /= 2.0;
  }
  std::string problem;
  const fe::Material& m = parts.model.materials[static_cast<std::size_t>(material)];
  fe::Section section = profile_section(profile, values, m.poisson_ratio, problem);
  if (!problem.empty()) parts.file.fail(card, line.line, problem, "check the dimensions of the " + profile);
  if (is_euler_beam(parts, card)) section.shear_area_y_m2 = section.shear_area_z_m2 = 0.0;
  const bool orthotropic = second != parts.second_shear_moduli.end();
  if (orthotropic) section = contracted_beam(section, m.shear_modulus_Pa, second->second);
  const std::size_t before = parts.model.elements.size();
  add_beams(parts, card, first_axis(parts, card), material, add_section(parts, card, section));
  for (std::size_t i = before; orthotropic && i < parts.model.elements.size(); ++i)
    check_orientation(parts, card, parts.model.elements[i]);
}

/// A material of the file with these numbers, or this one under the name of its set.
int find_or_add_material(InpParts& parts, fe::Material m) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); };
  auto& materials = parts.model.materials;
  const auto same = std::find_if(materials.begin(), materials.end(), [&](const fe::Material& other) {
    return near(other.youngs_modulus_Pa, m.youngs_modulus_Pa) && near(other.shear_modulus_Pa, m.shear_modulus_Pa) &&
           near(other.density_kg_m3, m.density_kg_m3);
  });
  if (same != materials.end()) return static_cast<int>(same - materials.begin());
  if (!parts.materials.emplace(upper_case(m.name), static_cast<int>(materials.size())).second) m.name += "_section";
  materials.push_back(m);
  return static_cast<int>(materials.size()) - 1;
}

void assign_general_beam(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"ELSET", "SECTION", "DENSITY", "POISSON"});
  if (upper_case(card.get("SECTION", "GENERAL")) != "GENERAL") {
    parts.file.fail(card, card.line, "only SECTION=GENERAL is supported on this card", "profiles go on *BEAM SECTION");
  }
  const InpLine& line = data_line(parts, card, 0, "A, I11, I12, I22, J");
  fe::Section s;
  s.area_m2 = above_zero(parts, card, line, 0);
  s.inertia_y_m4 = above_zero(parts, card, line, 1);
  s.inertia_yz_m4 = parts.file.number_or(card, line, 2, 0.0);
  s.inertia_z_m4 = above_zero(parts, card, line, 3);
  s.torsion_m4 = above_zero(parts, card, line, 4);
  if (const InpCard* shear = parts.card_after(card); shear != nullptr && shear->keyword == "TRANSVERSE SHEAR STIFFNESS") {
    const InpLine& stiffness = data_line(parts, *shear, 0, "K23 and K13");
    const double shear_modulus = above_zero(parts, card, data_line(parts, card, 2, "E and G"), 1);
    s.shear_area_z_m2 = above_zero(parts, *shear, stiffness, 0) / shear_modulus;
    s.shear_area_y_m2 = above_zero(parts, *shear, stiffness, 1) / shear_modulus;
  }
  if (s.inertia_yz_m4 * s.inertia_yz_m4 > s.inertia_y_m4 * s.inertia_z_m4) {
    parts.file.fail(card, line.line, "I12 is larger than sqrt(I11 I22), which no section can have",
                    "check the second moments of area");
  }
  const InpLine& moduli = data_line(parts, card, 2, "E and G");
  fe::Material m;
  m.name = parts.set(parts.element_sets, card, card.line, parts.file.required(card, "ELSET")).name;
  m.youngs_modulus_Pa = above_zero(parts, card, moduli, 0);
  m.shear_modulus_Pa = above_zero(parts, card, moduli, 1);
  m.poisson_ratio = std::clamp(m.youngs_modulus_Pa / (2.0 * m.shear_modulus_Pa) - 1.0, -0.99, 0.499);
  if (card.has("DENSITY")) {
    const InpLine density{card.line, {card.get("DENSITY")}};
    m.density_kg_m3 = parts.file.number(card, density, 0);
  }
  const int material = find_or_add_material(parts, m);
  const int section = add_section(parts, card, s);
  add_beams(parts, card, first_axis(parts, card), material, section);
}

/// *SHELL SECTION, and *USER SECTION of CalculiX' three-node user shell US3, whose constants begin with the thickness.
void assign_shell(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, card.keyword == "USER SECTION"
                             ? std::vector<std::string>{"ELSET", "MATERIAL", "CONSTANTS"}
                             : std::vector<std::string>{"ELSET", "MATERIAL", "SECTION INTEGRATION", "POISSON"});
  const int material = material_of(parts, card);
  fe::Section s;
  s.thickness_m = above_zero(parts, card, data_line(parts, card, 0, "the thickness"), 0);
  const int section = add_section(parts, card, s);
  for (const InpElement* element : parts.elements_of(card)) {
    if (inp_kind(element->type) != InpKind::shell) refuse_kind(parts, card, *element);
    add_whole(parts, to_element(parts, card, *element, fe::ElementType::shell, material, section));
  }
}

/// *SOLID SECTION: area of trusses; solids have no section of their own.
void assign_solid(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"ELSET", "MATERIAL", "CONTROLS", "ORIENTATION"});  // isotropic: no direction matters
  const int material = material_of(parts, card);
  const auto elements = parts.elements_of(card);
  if (elements.empty()) return;
  const InpKind kind = inp_kind(elements.front()->type);
  int section = -1;
  if (kind == InpKind::truss) {
    fe::Section s;
    s.area_m2 = above_zero(parts, card, data_line(parts, card, 0, "the area of the trusses"), 0);
    section = add_section(parts, card, s);
  }
  const fe::ElementType type = kind == InpKind::truss ? fe::ElementType::bar : fe::ElementType::solid;
  for (const InpElement* element : elements) {
    if (inp_kind(element->type) != kind || (kind != InpKind::truss && kind != InpKind::solid))
      refuse_kind(parts, card, *element);
    add_whole(parts, to_element(parts, card, *element, type, material, section));
  }
}

}  // namespace

void assign_inp_section(InpParts& parts, const InpCard& card) {
  (void)parts.file.required(card, "ELSET");
  if (card.keyword == "BEAM SECTION") return assign_beam(parts, card);
  if (card.keyword == "BEAM GENERAL SECTION") return assign_general_beam(parts, card);
  if (card.keyword == "SHELL SECTION" || card.keyword == "USER SECTION") return assign_shell(parts, card);
  assign_solid(parts, card);
}

}  // namespace twindeck::model_io
