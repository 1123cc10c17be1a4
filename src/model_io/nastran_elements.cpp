#include "model_io/nastran_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model_io/nastran_properties.hpp"

namespace twindeck::model_io::nastran {
namespace {

/// Number and nodes of an element; the rest follows by its kind.
fe::Element start_element(Parts& parts, const Card& card, fe::ElementType type, std::size_t first, std::size_t count) {
  fe::Element e;
  e.id = card.integer(0);
  if (!parts.element_ids.insert(e.id).second)
    card.fail(fmt::format("element {} is defined twice", e.id), "give each element a number of its own");
  e.type = type;
  for (std::size_t i = first; i < first + count; ++i) e.nodes.push_back(parts.node(card, card.integer(i)));
  if (type == fe::ElementType::beam || type == fe::ElementType::shell) parts.turning.insert(e.nodes.begin(), e.nodes.end());
  return e;
}

/// Where the deck counts the vector and the offsets of a member: three letters, G = displacement system of the end, B = basic.
/// Old decks have 1 or 2 there (vector or grid), which the fields in front say already.
std::string frames_of(const Card& card) {
  const std::string word = card.word(7);
  if (word.empty() || word == "0" || word == "1" || word == "2") return "GGG";
  if (word.size() != 3 || word.find_first_not_of("GB") != std::string::npos)
    card.fail(fmt::format("OFFT is '{}', of which GGG and its kin with B are read", word),
              "give the offsets in the displacement system of the grids");
  return word;
}

/// Offset of an end in basic axes.
Eigen::Vector3d offset_of(Parts& parts, const Card& card, std::size_t i, long grid, char frame) {
  const Eigen::Vector3d w = card.vector(i);
  if (w.isZero(0.0) || frame == 'B') return w;
  return parts.displacement_axes(card, grid).transpose() * w;
}

/// Pin flags: digits 1 to 6 of local displacements that carry no force.
std::uint16_t releases_of(const Card& card) {
  unsigned bits = 0;
  for (const std::size_t end : {0U, 1U}) {
    if (card.blank(8 + end) || card.text(8 + end) == "0") continue;
    const auto free = components(card, 8 + end);
    for (std::size_t i = 0; i < 6; ++i) bits |= free[i] ? 1U << (6 * end + i) : 0U;
  }
  return static_cast<std::uint16_t>(bits);
}

/// Mass that is not structural, per volume of a rod.
double rod_added_density(const Card& card, std::size_t area, std::size_t mass) {
  const double a = card.number(area);
  if (!(a > 0.0)) card.fail(fmt::format("the area is {:g}, expected a value above 0", a), "give the area");
  return card.number_or(mass, 0.0) / a;
}

/// Grids on the edges, in fields `first` and on: all of them, or none; the element has `corners` corners already.
void add_edge_grids(Parts& parts, const Card& card, std::size_t first, std::size_t count, fe::Element& e) {
  std::size_t given = 0;
  for (std::size_t i = first; i < first + count; ++i) given += card.blank(i) || card.text(i) == "0" ? 0 : 1;
  if (given == 0) return;
  if (given < count)
    card.fail(fmt::format("has {} of {} grids on its edges, which is not read", given, count), "give all, or none");
  for (std::size_t i = first; i < first + count; ++i) e.nodes.push_back(parts.node(card, card.integer(i)));
}

/// A member with what BAROR or BEAMOR says in the place of blank fields: property, vector, OFFT.
Card with_defaults(const Parts& parts, Card card) {
  const auto found = parts.member_defaults.find(card.name);
  if (found == parts.member_defaults.end()) return card;
  constexpr std::size_t property = 1, vector = 4, frames = 7;
  card.fields.resize(std::max(card.fields.size(), frames + 1));
  const bool own_vector = !card.blank(vector) || !card.blank(vector + 1) || !card.blank(vector + 2);
  for (const std::size_t i : {property, vector, vector + 1, vector + 2, frames})
    if (card.blank(i) && (i < vector || i == frames || !own_vector)) card.fields[i] = found->second->text(i);
  return card;
}

}  // namespace

Eigen::Vector3d plane_vector(Parts& parts, const Card& card, char frame) {
  const long a = card.integer(2);
  if (const std::string first = card.text(4); is_whole_number(first) && first != "0" && card.blank(5) && card.blank(6))
    return parts.grid_place(card, card.integer(4)) - parts.grid_place(card, a);
  const Eigen::Vector3d v = card.vector(4);
  return frame == 'B' ? v : Eigen::Vector3d(parts.displacement_axes(card, a).transpose() * v);
}

void read_member(Parts& parts, const Card& given) {
  const Card card = with_defaults(parts, given);
  fe::Element e = start_element(parts, card, fe::ElementType::beam, 2, 2);
  const long property = card.integer_or(1, e.id);
  const MemberProperty p = card.name == "CBAR" ? bar_property(parts, card, property) : beam_property(parts, card, property);
  e.material = p.material;
  e.section = p.section;
  if (p.section2 >= 0) e.section2 = p.section2;
  e.group = parts.model.sections[fe::slot(p.section)].name;
  const std::string frames = frames_of(card);
  const long a = card.integer(2), b = card.integer(3);
  e.offset_m = {offset_of(parts, card, 10, a, frames[1]), offset_of(parts, card, 13, b, frames[2])};
  e.releases = releases_of(card);
  const Eigen::Vector3d v = plane_vector(parts, card, frames[0]);
  const Eigen::Vector3d axis = parts.grid_place(card, b) + e.offset_m[1] - parts.grid_place(card, a) - e.offset_m[0];
  e.orientation = DeckModel::local_z(card, "the member", axis, v, "give X1, X2, X3 or G0 across the member (plane 1)");
  parts.model.elements.push_back(e);
}

void read_rod(Parts& parts, const Card& card) {
  const bool own = card.name == "CONROD";
  fe::Element e = start_element(parts, card, fe::ElementType::bar, own ? 1 : 2, 2);
  const Card& p = own ? card : parts.property(card, card.integer_or(1, e.id), {"PROD"});
  // PROD: PID MID A J C NSM; CONROD: EID G1 G2 MID A J C NSM.
  const std::size_t mid = own ? 3 : 1;
  const double added = rod_added_density(p, mid + 1, mid + 4), j = p.number_or(mid + 2, 0.0);
  e.material = parts.material(p, p.integer(mid), added, property_name(p));
  e.group = property_name(p);
  e.section = parts.add_section({.name = e.group, .area_m2 = p.number(mid + 1)});
  if (j > 0.0) {
    const double length = (parts.place(e.nodes[1]) - parts.place(e.nodes[0])).norm();
    if (!(length > 0.0)) card.fail("its two grids lie at one place", "give grids apart, or take the rod out");
    const double g = parts.model.materials[fe::slot(e.material)].shear_modulus_Pa;
    parts.twists.push_back({&card, e.nodes[0], e.nodes[1], g * j / length});
  }
  parts.model.elements.push_back(e);
}

void finish_rods(Parts& parts) {
  std::set<int> holds = parts.turning;
  for (const fe::RigidLink& link : parts.model.links) holds.insert(link.slave);
  for (const fe::Support& support : parts.model.supports)
    if (support.fixed[3] && support.fixed[4] && support.fixed[5]) holds.insert(support.node);
  std::size_t left_out = 0;
  for (const Parts::Twist& twist : parts.twists) {
    if (!holds.contains(twist.a) || !holds.contains(twist.b)) {
      ++left_out;
      continue;
    }
    Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
    axes.row(0) = (parts.place(twist.b) - parts.place(twist.a)).normalized();
    parts.add_spring("crod_" + twist.card->text(0) + "_torsion", "rod_torsion", twist.a, twist.b, 3, axes, twist.stiffness);
  }
  if (left_out > 0)
    parts.notes.push_back(
        fmt::format("the torsion of {} rods is left out: no beam, shell or support holds the rotations of both "
                    "ends (AUTOSPC takes them out in Nastran)",
                    left_out));
}

void read_shell(Parts& parts, const Card& card) {
  const bool quadratic = card.name == "CTRIA6" || card.name == "CQUAD8";
  const std::size_t corners = card.name.starts_with("CTRIA") ? 3 : 4;
  // CTRIA6: THETA, ZOFFS, T1 … behind six grids; CQUAD8: T1 …, THETA, ZOFFS behind eight.
  const std::size_t offset = !quadratic ? 3 + corners : corners == 3 ? 9 : 15, thicknesses = 10;
  fe::Element e = start_element(parts, card, fe::ElementType::shell, 2, corners);
  if (quadratic) add_edge_grids(parts, card, 2 + corners, corners, e);
  const Card& p = parts.property(card, card.integer_or(1, e.id), {"PSHELL"});
  const std::string name = property_name(p);
  if (card.number_or(offset, 0.0) != 0.0)
    card.fail("has an offset (ZOFFS), which is not read", "put the grids on the middle surface, or join them by RBE2");
  const double t = p.number_or(2, 0.0);
  if (!(t > 0.0)) p.fail(fmt::format("the thickness is {:g}, expected a value above 0", t), "give T in field 4");
  for (std::size_t i = thicknesses; i < thicknesses + corners; ++i)
    if (std::abs(card.number_or(i, t) - t) > 1e-9 * t)
      card.fail("has thicknesses at its corners that are not the property's, which is not read", "give PSHELL the thickness");
  const long membrane = p.integer(1), bending = p.integer_or(3, 0);
  if (bending != membrane)
    p.fail(bending == 0 ? "has no MID2, so that it is a membrane without bending, which is not read"
                        : "has MID2 other than MID1, which is not read",
           "give MID2 the material of MID1");
  if (p.integer_or(10, 0) != 0) p.fail("couples membrane and bending (MID4), which is not read", "leave MID4 blank");
  e.group = name;
  e.material = parts.material(p, membrane, p.number_or(7, 0.0) / t, name);
  fe::Section s{.name = name, .thickness_m = t, .bending_inertia_ratio = p.number_or(4, 1.0)};
  if (const long shear = p.integer_or(5, 0); shear != 0) {  // MID3; blank: rigid in transverse shear
    const double ratio = p.number_or(6, fe::homogeneous_shear_ratio);
    if (!(ratio > 0.0)) p.fail(fmt::format("TS/T is {:g}, expected a value above 0", ratio), "leave it blank, or mend it");
    const fe::Material& m = parts.model.materials[fe::slot(e.material)];
    s.shear_thickness_ratio =
        ratio * parts.elastic(p, shear).shear_modulus_Pa * 2.0 * (1.0 + m.poisson_ratio) / m.youngs_modulus_Pa;
  }
  e.section = parts.add_section(s);
  parts.add_element(e);
}

void read_solid(Parts& parts, const Card& card) {
  const std::size_t corners = card.name == "CTETRA" ? 4 : 8;
  fe::Element e = start_element(parts, card, fe::ElementType::solid, 2, corners);
  add_edge_grids(parts, card, 2 + corners, corners == 4 ? 6 : 12, e);
  // G9 to G12 lie on the bottom, G13 to G16 between, G17 to G20 on the top: here the top comes second.
  if (e.nodes.size() == 20) std::rotate(e.nodes.begin() + 12, e.nodes.begin() + 16, e.nodes.end());
  const Card& p = parts.property(card, card.integer_or(1, e.id), {"PSOLID"});
  if (const std::string kind = p.word(6); !kind.empty() && kind != "SMECH")
    p.fail(fmt::format("is '{}', no solid of the structure", kind), "leave the fluid out");
  e.group = property_name(p);
  e.material = parts.material(p, p.integer(1));
  parts.add_element(e);
}

}  // namespace twindeck::model_io::nastran
