#include "model_io/inp_sections.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "model_io/inp_attachments.hpp"
#include "model_io/inp_expanded_beam.hpp"
#include "model_io/profiles.hpp"

namespace twindeck::model_io {
namespace {

/// The section of the group's name if it has these numbers, or a new one.
int section_of_set(InpParts& parts, const InpCard& card, fe::Section section) {
  const InpSet& set = parts.set(parts.element_sets, card, card.get("ELSET"));
  const auto first = set.members.empty() ? parts.elements.end() : parts.elements.find(set.members.front());
  section.name = first == parts.elements.end() ? set.name : parts.group_set(card, first->second).name;
  return parts.add_section(section);
}

/// The material that the card names, isotropic or a beam's own (InpParts::second_shear_moduli).
int any_material_of(InpParts& parts, const InpCard& card) {
  const std::string name = card.required("MATERIAL");
  const auto found = parts.materials.find(upper_case(name));
  if (found == parts.materials.end())
    card.fail(fmt::format("material '{}' is not defined{}", name,
                          did_you_mean(name, each_of(parts.model.materials, &fe::Material::name))),
              "define it by *MATERIAL");
  if (parts.model.materials[fe::slot(found->second)].youngs_modulus_Pa <= 0.0)
    card.fail(fmt::format("material '{}' has no *ELASTIC", name), "give E and nu");
  return found->second;
}

int material_of(InpParts& parts, const InpCard& card) {
  const int material = any_material_of(parts, card);
  if (parts.second_shear_moduli.contains(material))
    card.fail(fmt::format("material '{}' is orthotropic, which only beams may be", card.get("MATERIAL")),
              "give E and nu of an isotropic material");
  return material;
}

double above_zero(const InpLine& line, std::size_t i) {
  const double value = line.number(i);
  if (value <= 0.0) line.fail(fmt::format("field {} is {}, expected a value above 0", i + 1, value), "SI units");
  return value;
}

fe::Element to_element(InpParts& parts, const InpCard& card, const InpElement& element, fe::ElementType type, int material,
                       int section) {
  if (element.used > 1)
    card.fail(fmt::format("element {} already has a section", element.id), "take it out of one of the sets");
  fe::Element e;
  e.id = element.id;
  e.type = type;
  e.group = parts.group_of(card, element);
  e.material = material;
  e.section = section;
  e.nodes = each_of(element.nodes, [&](long id) { return parts.node(*element.at, id); });
  return e;
}

/// Beams whose local y is n1 of the data line below those of the section; our local z is n2 = t × n1.
/// @param centroid  of the section in its y and z, from the node
void add_beams(InpParts& parts, const InpCard& card, int material, int section, std::size_t direction_line = 1,
               const Eigen::Vector2d& centroid = Eigen::Vector2d::Zero()) {
  Eigen::Vector3d n1(0.0, 0.0, -1.0);
  if (card.data.size() > direction_line) n1 = card.data[direction_line].vector(0);
  if (parts.is_turned()) n1 = (parts.scopes[fe::slot(parts.scope)].rotation * n1).eval();
  for (const InpElement* element : parts.elements_of(card, InpKind::beam)) {
    if (element->type.find("OS") != std::string::npos)
      parts.note_once(
          "B31OS and B32OS are read as B31 and B32: the warping of their open sections, which stiffens them in "
          "torsion, is left out");
    for (const long id : element->nodes)
      if (parts.with_normal.contains(id))
        element->at->fail(fmt::format("element {} is a beam, and node {} has a normal behind its coordinates, which turns the "
                                      "section and is not read",
                                      element->id, parts.node_name(id)),
                          "leave the normal out, and give n1 in the second data line of the section");
    Eigen::Vector3d own_n1 = n1;
    if (element->towards >= 0)
      own_n1 =
          parts.place(parts.node(*element->at, element->towards)) - parts.place(parts.node(*element->at, element->nodes[0]));
    parts.add_beam(to_element(parts, card, *element, fe::ElementType::beam, material, section),
                   [&](fe::Element& piece, const Eigen::Vector3d& axis) {
                     piece.orientation =
                         DeckModel::local_z(card, fmt::format("element {}", element->id), axis, own_n1,
                                            "give n1 across the beam in the second data line (default 0, 0, -1)");
                     DeckModel::put_beside(piece, axis, centroid);
                   });
  }
}

/// A profile as it is drawn, where the node lies in the drawing (the centroid without one), and how many data lines it takes.
struct DrawnProfile {
  Shape shape;
  std::optional<Eigen::Vector2d> node = {};
  std::size_t lines = 1;
};

/// ARBITRARY: number of segments, two points and a thickness, then a point and a thickness a line; closed where the last point
/// is the first.
DrawnProfile draw_segments(const InpCard& card) {
  DrawnProfile drawn{{}, Eigen::Vector2d::Zero(), static_cast<std::size_t>(std::clamp(card.data[0].integer(0), 1L, 1000L))};
  const auto point = [](const InpLine& line, std::size_t i) { return Eigen::Vector2d(line.number(i), line.number(i + 1)); };
  const Eigen::Vector2d first = point(card.data[0], 1);
  Eigen::Vector2d from = first;
  double twice_area = 0.0, around = 0.0;
  for (std::size_t i = 0; i < drawn.lines; ++i) {
    const InpLine& line = card.line_of(i, "a point and a thickness of a segment");
    const Eigen::Vector2d to = point(line, i == 0 ? 3 : 0);
    const double length = (to - from).norm(), thickness = above_zero(line, i == 0 ? 5 : 2);
    if (!(length > 0.0)) line.fail("the segment has no length", "give its other end");
    drawn.shape.walls.push_back({from, to, thickness});
    twice_area += from[0] * to[1] - from[1] * to[0];
    around += length / thickness;
    from = to;
  }
  const bool closed = drawn.lines > 2 && (from - first).norm() < 1e-9 * around * drawn.shape.walls[0].thickness;
  if (closed) drawn.shape.closed_torsion = bredt(std::abs(twice_area) / 2.0, around);
  return drawn;
}

/// A regular hexagon's tube by the radius of its corners and its wall.
Shape hexagonal_tube(double radius, double wall) {
  Shape shape;
  const double middle = radius - wall / std::sqrt(3.0), area = 1.5 * std::sqrt(3.0) * middle * middle;
  shape.fits = middle > 0.0 && wall > 0.0;
  const auto corner = [&](int i) {
    return Eigen::Vector2d(middle * std::cos(i * std::numbers::pi / 3.0), middle * std::sin(i * std::numbers::pi / 3.0));
  };
  for (int i = 0; i < 6; ++i) shape.walls.push_back({corner(i), corner(i + 1), wall});
  shape.closed_torsion = bredt(area, 6.0 * middle / wall);
  return shape;
}

DrawnProfile draw_profile(const InpCard& card, std::string profile) {
  const InpLine& line = card.line_of(0, "the dimensions");
  const auto d = [&](std::size_t i) { return line.number(i); };
  if (profile == "THICK PIPE") profile = "PIPE";
  if (profile.starts_with("RECT")) return {rectangles({{0.0, 0.0, d(0), d(1)}})};
  if (profile.starts_with("CIRC")) {
    // Abaqus gives the radius; CalculiX both diameters, of an ellipse if they differ.
    if (line.fields.size() > 1 && d(1) != d(0)) line.fail("an ellipse is not supported", "give a circle");
    return {circle(line.fields.size() > 1 ? d(0) / 2.0 : d(0))};
  }
  if (profile == "PIPE") return {circle(d(0), d(0) - d(1))};
  if (profile == "BOX") return {box(d(0), d(1), {d(2), d(3), d(4), d(5)}), Eigen::Vector2d(d(0), d(1)) / 2.0};
  if (profile == "I") return {i_shape(d(1), {d(2), d(3)}, {d(4), d(5)}, d(6)), Eigen::Vector2d(0.0, d(0))};
  if (profile == "L") return {angle(d(0), d(1), d(2), d(3)), Eigen::Vector2d(d(3), d(2)) / 2.0};
  if (profile == "HEX") return {hexagonal_tube(d(0), d(1))};
  if (profile == "ARBITRARY") return draw_segments(card);
  if (profile != "TRAPEZOID") {
    const std::vector<std::string> known = {"ARBITRARY", "BOX",  "CIRC", "HEX",        "I",
                                            "L",         "PIPE", "RECT", "THICK PIPE", "TRAPEZOID"};
    card.fail(fmt::format("unsupported SECTION={}{}", profile, did_you_mean(profile, known)),
              fmt::format("supported are {}, and GENERAL on *BEAM GENERAL SECTION", fmt::join(known, ", ")));
  }
  DrawnProfile drawn;  // lower width, height, upper width, the node above the lower side
  drawn.shape.outline = {{-d(0) / 2.0, 0.0}, {d(0) / 2.0, 0.0}, {d(2) / 2.0, d(1)}, {-d(2) / 2.0, d(1)}};
  drawn.shape.fits = d(0) > 0.0 && d(1) > 0.0 && d(2) > 0.0;
  drawn.node = Eigen::Vector2d(0.0, d(3));
  return drawn;
}

/// The two shear moduli of an orthotropic beam hold in its own axes, so that *ORIENTATION has to name them.
void check_orientation(InpParts& parts, const InpCard& card, const fe::Element& e) {
  (void)card.required("ORIENTATION");
  const InpOrientation axes = inp_axes_of(parts, card);
  const Eigen::Vector3d t = (parts.place(e.nodes[1]) - parts.place(e.nodes[0])).normalized();
  constexpr double aligned = 1.0 - 1e-6;  // 0.08 degrees
  if (std::abs(axes.row(0).dot(t)) < aligned || std::abs(axes.row(2).dot(e.orientation)) < aligned)
    card.fail(fmt::format("orientation '{}' is not along the axes of element {}", card.get("ORIENTATION"), e.id),
              "its x' is the beam's axis and its y' the direction n1");
}

/// Whether the card's elements are B33, Euler's beam, which is rigid in shear.
bool is_euler_beam(InpParts& parts, const InpCard& card) {
  const InpSet& set = parts.set(parts.element_sets, card, card.get("ELSET"));
  const auto euler = std::ranges::count_if(set.members, [&](long id) {
    const auto element = parts.elements.find(id);
    return element != parts.elements.end() && element->second.type == "B33";
  });
  if (euler > 0 && euler < std::ssize(set.members))
    card.fail("its set mixes B33, which is rigid in shear, with other beams", "give the B33 a set and a section of their own");
  return euler > 0;
}

void assign_beam(InpParts& parts, const InpCard& card) {
  card.allow({"ELSET", "MATERIAL", "SECTION", "POISSON", "TEMPERATURE", "ORIENTATION"});
  const std::string profile = upper_case(card.required("SECTION"));
  const DrawnProfile drawn = draw_profile(card, profile);
  const int material = any_material_of(parts, card);
  const auto second = parts.second_shear_moduli.find(material);
  const fe::Material& m = parts.model.materials[fe::slot(material)];
  const ProfileSection of_profile = profile_section(drawn.shape, m.poisson_ratio);
  fe::Section section = of_profile.section;
  if (!of_profile.possible)
    card.data[0].fail("a dimension is not above 0, or the dimensions do not fit together",
                      fmt::format("check the dimensions of the {}, or give another shape by *BEAM GENERAL SECTION", profile));
  if (of_profile.beside) parts.note_once(note_beside(card.get("ELSET")));
  Eigen::Vector2d centroid = of_profile.centroid - drawn.node.value_or(of_profile.centroid);
  constexpr double rounding = 1e-9;  // [-] of the section's size
  if (centroid.norm() < rounding * std::sqrt(section.area_m2)) centroid.setZero();
  if (is_euler_beam(parts, card)) section.shear_area_y_m2 = section.shear_area_z_m2 = 0.0;
  const bool orthotropic = second != parts.second_shear_moduli.end();
  if (orthotropic) section = contracted_beam(section, m.shear_modulus_Pa, second->second);
  const std::size_t before = parts.model.elements.size();
  add_beams(parts, card, material, section_of_set(parts, card, section), drawn.lines, centroid);
  for (std::size_t i = before; orthotropic && i < parts.model.elements.size(); ++i)
    check_orientation(parts, card, parts.model.elements[i]);
}

/// A material of the file with these numbers, or this one under the name of its set.
int find_or_add_material(InpParts& parts, fe::Material m) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); };
  auto& materials = parts.model.materials;
  const auto same = std::ranges::find_if(materials, [&](const fe::Material& other) {
    return near(other.youngs_modulus_Pa, m.youngs_modulus_Pa) && near(other.shear_modulus_Pa, m.shear_modulus_Pa) &&
           near(other.density_kg_m3, m.density_kg_m3);
  });
  if (same != materials.end()) return static_cast<int>(same - materials.begin());
  if (!parts.materials.emplace(upper_case(m.name), static_cast<int>(materials.size())).second) m.name += "_section";
  materials.push_back(m);
  return static_cast<int>(materials.size()) - 1;
}

void assign_general_beam(InpParts& parts, const InpCard& card) {
  card.allow({"ELSET", "SECTION", "DENSITY", "POISSON"});
  if (upper_case(card.get("SECTION", "GENERAL")) != "GENERAL")
    card.fail("only SECTION=GENERAL is supported on this card", "profiles go on *BEAM SECTION");
  const InpLine& line = card.line_of(0, "A, I11, I12, I22, J");
  fe::Section s{
      .name = {}, .area_m2 = above_zero(line, 0), .inertia_y_m4 = above_zero(line, 1), .inertia_yz_m4 = line.number_or(2, 0.0)};
  s.inertia_z_m4 = above_zero(line, 3);
  s.torsion_m4 = above_zero(line, 4);
  const InpLine& moduli = card.line_of(2, "E and G");
  fe::Material m{.name = parts.set(parts.element_sets, card, card.required("ELSET")).name,
                 .youngs_modulus_Pa = above_zero(moduli, 0),
                 .shear_modulus_Pa = above_zero(moduli, 1)};
  m.poisson_ratio = std::clamp(m.youngs_modulus_Pa / (2.0 * m.shear_modulus_Pa) - 1.0, -0.99, 0.499);
  if (card.has("DENSITY")) m.density_kg_m3 = card.value("DENSITY").number(0);
  if (const InpCard* shear = parts.card_after(card); shear != nullptr && shear->keyword == "TRANSVERSE SHEAR STIFFNESS") {
    const InpLine& stiffness = shear->line_of(0, "K23 and K13");
    s.shear_area_z_m2 = above_zero(stiffness, 0) / m.shear_modulus_Pa;
    s.shear_area_y_m2 = above_zero(stiffness, 1) / m.shear_modulus_Pa;
  }
  if (s.inertia_yz_m4 * s.inertia_yz_m4 > s.inertia_y_m4 * s.inertia_z_m4)
    line.fail("I12 is larger than sqrt(I11 I22), which no section can have", "check the second moments of area");
  const int material = find_or_add_material(parts, m);
  add_beams(parts, card, material, section_of_set(parts, card, s));
}

/// *SHELL SECTION, and *USER SECTION of CalculiX' three-node user shell US3, whose constants begin with the thickness.
void assign_shell(InpParts& parts, const InpCard& card) {
  std::vector<std::string> known = {"ELSET",   "MATERIAL",    "SECTION INTEGRATION",
                                    "POISSON", "ORIENTATION", "CONTROLS"};  // isotropic: no direction matters
  if (card.keyword == "USER SECTION") known = {"ELSET", "MATERIAL", "CONSTANTS"};
  if (const std::string offset = upper_case(card.get("OFFSET", "0")); offset == "0" || offset == "0." || offset == "0.0")
    known.emplace_back("OFFSET");
  card.allow(known);
  const int material = material_of(parts, card);
  fe::Section s;
  s.thickness_m = above_zero(card.line_of(0, "the thickness"), 0);
  for (const InpElement* element : parts.elements_of(card, InpKind::shell)) {
    s.shear_thickness_ratio = inp_shear_flexible(element->type) ? fe::homogeneous_shear_ratio : 0.0;
    const int section = section_of_set(parts, card, s);
    parts.add_element(to_element(parts, card, *element, fe::ElementType::shell, material, section));
  }
}

/// *SOLID SECTION: area of trusses; solids have no section of their own.
void assign_solid(InpParts& parts, const InpCard& card) {
  card.allow({"ELSET", "MATERIAL", "CONTROLS", "ORIENTATION"});  // isotropic: no direction matters
  const int material = material_of(parts, card);
  const auto elements = parts.elements_of(card, InpKind::truss, InpKind::solid);
  if (elements.empty()) return;
  const InpKind kind = inp_kind(elements.front()->type);
  const bool truss = kind == InpKind::truss;
  fe::Section s;
  if (truss) s.area_m2 = above_zero(card.line_of(0, "the area of the trusses"), 0);
  const int section = truss ? section_of_set(parts, card, s) : -1;
  for (const InpElement* element : elements) {
    if (inp_kind(element->type) != kind) card.fail("its set mixes trusses and solids", "give each kind a set and a section");
    parts.add_element(
        to_element(parts, card, *element, truss ? fe::ElementType::bar : fe::ElementType::solid, material, section));
  }
}

/// *ELASTIC, *DENSITY and *EXPANSION belong to the last *MATERIAL.
fe::Material& current_material(InpParts& parts, const InpCard& card) {
  if (parts.model.materials.empty()) card.fail("stands before any *MATERIAL", "move it below one");
  return parts.model.materials.back();
}

const InpLine& one_line(const InpCard& card, const char* what) {
  if (card.data.empty()) card.fail("has no data line", fmt::format("give {} below it", what));
  if (card.data.size() > 1)
    card.data[1].fail("has more than one data line: values that depend on temperature are not supported",
                      fmt::format("give {} at one temperature", what));
  return card.data.front();
}

/// The material of a beam as our own CalculiX files have it (inp_expanded_beam.hpp): one E, no Poisson's ratio, G12 and G13.
void read_beam_constants(InpParts& parts, const InpCard& card, fe::Material& material) {
  if (card.data.size() != 2)
    card.fail(fmt::format("has {} data lines, expected 2", card.data.size()),
              "give E1, E2, E3, nu12, nu13, nu23, G12, G13 on the first and G23 on the second");
  std::array<double, 9> constants{};
  for (std::size_t i = 0; i < 8; ++i) constants[i] = card.data[0].number(i);
  constants[8] = card.data[1].number(0);
  const bool one_modulus = constants[0] > 0.0 && constants[1] == constants[0] && constants[2] == constants[0];
  if (!one_modulus || constants[3] != 0.0 || constants[4] != 0.0 || constants[5] != 0.0)
    card.data[0].fail("is orthotropic with several E or Poisson's ratios, which is not supported",
                      "give E and nu of an isotropic material");
  for (std::size_t i = 6; i < 9; ++i)
    if (constants[i] <= 0.0) card.data[i / 8].fail("a shear modulus is not above 0", "give G12, G13, G23 in Pa");
  material.youngs_modulus_Pa = constants[0];
  material.poisson_ratio = 0.0;
  material.shear_modulus_Pa = constants[6];
  parts.second_shear_moduli[static_cast<int>(parts.model.materials.size()) - 1] = constants[7];
}

/// x' along a, b in the x'-y' plane.
InpOrientation axes_through(const InpLine& line, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d z = a.cross(b);
  if (z.norm() < 1e-9 * a.norm() * b.norm() || a.norm() == 0.0)
    line.fail("points a and b lie in one direction", "b gives the x'-y' plane");
  InpOrientation axes;
  axes.row(0) = a.normalized();
  axes.row(2) = z.normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  return axes;
}

}  // namespace

void assign_inp_section(InpParts& parts, const InpCard& card) {
  (void)card.required("ELSET");
  if (card.keyword == "BEAM SECTION") return assign_beam(parts, card);
  if (card.keyword == "BEAM GENERAL SECTION") return assign_general_beam(parts, card);
  if (card.keyword.starts_with("SHELL") || card.keyword == "USER SECTION") return assign_shell(parts, card);
  assign_solid(parts, card);
}

void read_inp_material(InpParts& parts, const InpCard& card) {
  const std::string name = card.required("NAME");
  if (!parts.materials.emplace(upper_case(name), static_cast<int>(parts.model.materials.size())).second)
    card.fail(fmt::format("material '{}' is defined twice", name), "keep one of the two");
  parts.model.materials.push_back({.name = name});
}

void read_inp_elastic(InpParts& parts, const InpCard& card) {
  fe::Material& material = current_material(parts, card);
  card.allow({"TYPE"});
  const std::string type = upper_case(card.get("TYPE", "ISOTROPIC"));
  if (type == "ENGINEERING CONSTANTS") return read_beam_constants(parts, card, material);
  if (type != "ISOTROPIC" && type != "ISO")
    card.fail(fmt::format("TYPE={} is not supported, expected ISOTROPIC", type),
              "the members of a frame or deck are isotropic here; give E and nu");
  parts.second_shear_moduli.erase(static_cast<int>(parts.model.materials.size()) - 1);
  const InpLine& line = one_line(card, "E and nu");
  material.youngs_modulus_Pa = line.number(0);
  material.poisson_ratio = line.number_or(1, 0.0);
  if (material.youngs_modulus_Pa <= 0.0) line.fail("E must be above 0", "give E in Pa, and nu");
  DeckModel::check_poisson_ratio(line, material.poisson_ratio);
  material.shear_modulus_Pa = material.youngs_modulus_Pa / (2.0 * (1.0 + material.poisson_ratio));
}

void read_inp_expansion(InpParts& parts, const InpCard& card) {
  (void)current_material(parts, card);
  const int material = static_cast<int>(parts.model.materials.size()) - 1;
  const std::string type = upper_case(card.get("TYPE", "ISO"));
  // What is not one number matters once a temperature acts, which is said there.
  if (card.data.size() == 1 && (type == "ISO" || type == "ISOTROPIC"))
    parts.expansion[material] = {card.data.front().number(0), 0.0};
  else
    parts.uneven_expansion.emplace(material, &card);
}

void read_inp_density(InpParts& parts, const InpCard& card) {
  fe::Material& material = current_material(parts, card);
  const InpLine& line = one_line(card, "the density");
  material.density_kg_m3 = line.number(0);
  if (material.density_kg_m3 < 0.0) line.fail("the density must not be negative", "give it in kg/m3");
}

void read_inp_orientation(InpParts& parts, const InpCard& card) {
  card.allow({"NAME", "SYSTEM", "DEFINITION"});
  const std::string definition = upper_case(card.get("DEFINITION", "COORDINATES"));
  if (upper_case(card.get("SYSTEM", "RECTANGULAR")) != "RECTANGULAR" || (definition != "COORDINATES" && definition != "NODES"))
    card.fail("only SYSTEM=RECTANGULAR by coordinates or nodes is supported", "give the points a and b");
  if (card.data.empty()) card.fail("has no data line", "give the points a and b");
  Eigen::Vector3d a, b;
  if (definition == "NODES") {
    const auto place = [&](std::size_t field) { return parts.place(parts.node(card, parts.node_id(card.data[0], field))); };
    const Eigen::Vector3d origin = !card.data[0].blank(2) ? place(2) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    a = place(0) - origin;
    b = place(1) - origin;
  } else {
    (void)card.data[0].number(5);
    a = card.data[0].vector(0);
    b = card.data[0].vector(3);
  }
  InpOrientation axes = axes_through(card.data[0], a, b);
  const InpScope& scope = parts.scopes[fe::slot(parts.scope)];
  // Nodes are turned with their instance already.
  if (scope.turned() && definition == "COORDINATES") axes = (axes * scope.rotation.transpose()).eval();
  parts.orientations[parts.key_here(card.required("NAME"))] = axes;
}

void read_inp_transform(InpParts& parts, const InpCard& card) {
  card.allow({"NSET", "TYPE"});
  const std::string type = upper_case(card.get("TYPE", "R"));
  if (type != "R" && type != "C" && type != "S") card.fail(fmt::format("unsupported TYPE={}", type), "R, C and S are read");
  const InpLine& line = card.line_of(0, "the points a and b");
  const InpScope& scope = parts.scopes[fe::slot(parts.scope)];
  const Eigen::Vector3d a = scope.rotation * line.vector(0), b = scope.rotation * line.vector(3);
  for (const long id : parts.set(parts.node_sets, card, card.required("NSET")).members) {
    if (type == "R") {
      parts.node_axes[id] = axes_through(line, a, b);
      continue;
    }
    const Eigen::Vector3d axis = (b - a).normalized(), arm = parts.place(parts.node(card, id)) - a - scope.shift_m;
    const Eigen::Vector3d around = axis.cross(arm), radial = type == "S" ? arm : Eigen::Vector3d(around.cross(axis));
    if (!(around.norm() > 1e-9 * arm.norm()))
      line.fail(fmt::format("node {} lies on the axis, where no direction is radial", parts.node_name(id)),
                "take it out of the set");
    parts.node_axes[id] = axes_through(line, radial, around);
  }
}

}  // namespace twindeck::model_io
