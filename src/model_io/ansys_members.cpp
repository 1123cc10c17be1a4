#include "model_io/ansys_members.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <vector>

#include "core/lists.hpp"
#include "model_io/ansys_sections.hpp"
#include "model_io/profiles.hpp"

/// Beams, bars, shells and solids; springs, masses and supports.
namespace twindeck::model_io::ansys {
namespace {

constexpr double upright = 1e-4;       ///< [-] slope against global Z below which ANSYS takes y from global Y
constexpr double least_across = 1e-6;  ///< [-] part of a direction that has to lie across its beam

fe::Element element_of(Builder& builder, const Member& member, fe::ElementType type, const std::vector<long>& nodes) {
  fe::Element e;
  e.id = member.id;
  e.type = type;
  e.nodes = each_of(nodes, [&](long id) { return builder.node(id); });
  if (std::set<int>(e.nodes.begin(), e.nodes.end()).size() != nodes.size())
    builder.fail(member, "names a node twice", "give different nodes");
  return e;
}

/// The first nodes of the element, without one that only gives a direction.
std::vector<long> ends_of(const Member& member) {
  return {member.element.nodes.begin(), member.element.nodes.begin() + static_cast<std::ptrdiff_t>(member.type().nodes)};
}

/// Our local z, which is ANSYS's: towards the third node; without one, y is parallel to the global X-Y plane, and along global
/// Y for a beam along global Z.
Eigen::Vector3d direction_of_z(const Builder& builder, const Member& member, const Eigen::Vector3d& axis) {
  const auto& nodes = member.element.nodes;
  const std::size_t ends = member.middle() != 0 ? 3 : 2;
  if (const long third = nodes.size() > ends ? nodes.back() : 0; third != 0) {
    const auto found = builder.parts.nodes.find(third);
    if (found == builder.parts.nodes.end())
      builder.fail(member, fmt::format("its direction node {} is not defined", third), "define it, or leave it out");
    const Eigen::Vector3d to = found->second.x_m - builder.parts.nodes.at(nodes[0]).x_m;
    if (axis.cross(to).norm() <= least_across * to.norm())
      builder.fail(member, fmt::format("its direction node {} lies on its axis", third), "move it beside the beam");
    return to;
  }
  if (axis.head<2>().norm() <= upright) return axis.cross(Eigen::Vector3d::UnitY());
  return Eigen::Vector3d::UnitZ();
}

/// A beam, or two through the node in its middle.
void add_beam(Builder& builder, const Member& member) {
  std::vector<long> nodes = ends_of(member);
  if (member.middle() != 0) nodes.insert(nodes.begin() + 1, member.middle());
  fe::Element e = element_of(builder, member, fe::ElementType::beam, nodes);
  e.material = builder.material(member, member.element.material, false);
  const CrossSection cross = beam_section(builder, member, builder.parts.model.materials[fe::slot(e.material)].poisson_ratio);
  e.free_strain = -cross.initial_strain;
  e.section = builder.parts.add_section(cross.section);
  e.group = builder.group(member, cross.section.name);
  builder.parts.add_beam(e, [&](fe::Element& piece, const Eigen::Vector3d& chord) {
    if (!(chord.norm() > 0.0)) builder.fail(member, "has no length", "merge its nodes, or take it out");
    if (member.type().kind == Kind::plane_beam) {
      if (chord.z() != 0.0) builder.fail(member, "is a BEAM3 that leaves the X-Y plane", "use BEAM188 for a frame in space");
      piece.orientation = Eigen::Vector3d::UnitZ();
      return;
    }
    const Eigen::Vector3d axis = chord.normalized();
    Eigen::Vector3d z = direction_of_z(builder, member, axis);
    z = (z - z.dot(axis) * axis).normalized();
    if (cross.turn_rad != 0.0 && member.element.nodes.size() == 2) z = Eigen::AngleAxisd(cross.turn_rad, axis) * z;
    piece.orientation = z;
    DeckModel::put_beside(piece, axis, -cross.node);
  });
}

void add_bar(Builder& builder, const Member& member) {
  fe::Element e = element_of(builder, member, fe::ElementType::bar, ends_of(member));
  const CrossSection cross = bar_section(builder, member);
  e.free_strain = -cross.initial_strain;
  e.material = builder.material(member, member.element.material, false);
  e.section = builder.parts.add_section(cross.section);
  e.group = builder.group(member, cross.section.name);
  builder.parts.model.elements.push_back(e);
}

/// The nodes of a shell, each once: a triangle is a quadrilateral that repeats a node, and of eight nodes it repeats K as L and
/// as the node between them. Without any node on its edges it is linear.
std::vector<long> nodes_of_shell(const Builder& builder, const Member& member) {
  const auto& all = member.element.nodes;
  const auto left_out = all.size() > 4 ? std::count(all.begin() + 4, all.end(), 0L) : 0;
  const bool linear = all.size() <= 4 || left_out == std::ssize(all) - 4;
  if (!linear && left_out > 0)
    builder.fail(member, "leaves out some of the nodes on its edges, which is not supported", "give all, or none");
  std::vector<long> nodes;
  for (const long id :
       linear ? std::vector<long>(all.begin(), all.begin() + std::min<std::ptrdiff_t>(4, std::ssize(all))) : all)
    if (!contains(nodes, id)) nodes.push_back(id);
  return nodes;
}

void add_shell(Builder& builder, const Member& member) {
  const std::vector<long> corners = nodes_of_shell(builder, member);
  if (corners.size() < 3) builder.fail(member, "has fewer than three different nodes", "give three or four");
  fe::Element e = element_of(builder, member, fe::ElementType::shell, corners);
  const CrossSection cross = shell_section(builder, member);
  e.material = builder.material(member, cross.material > 0 ? cross.material : member.element.material, true);
  e.section = builder.parts.add_section(cross.section);
  e.group = builder.group(member, cross.section.name);
  builder.parts.add_element(e);
}

void add_solid(Builder& builder, const Member& member) {
  std::vector<long> nodes = member.element.nodes;
  if (nodes.size() > 8 && std::all_of(nodes.begin() + 8, nodes.end(), [](long id) { return id == 0; })) nodes.resize(8);
  if (contains(nodes, 0L))
    builder.fail(member, "leaves out some of the nodes on its edges, which is not supported", "give all, or none");
  const std::size_t different = std::set<long>(nodes.begin(), nodes.end()).size();
  // A tetrahedron is written as a hexahedron I, J, K, K, M, M, M, M, and its edges as those of one: I-J, J-K, K, K-I, M four
  // times, I-M, J-M, K-M twice.
  const bool tetrahedron = nodes.size() >= 8 && different == (nodes.size() == 8 ? 4U : 10U) && nodes[2] == nodes[3] &&
                           std::all_of(nodes.begin() + 4, nodes.begin() + 8, [&](long id) { return id == nodes[4]; });
  const std::vector<std::size_t> places = {0, 1, 2, 4, 8, 9, 11, 16, 17, 18};
  if (tetrahedron)
    for (std::size_t i = 0; i < different; ++i) nodes[i] = member.element.nodes[places[i]];
  if (tetrahedron) nodes.resize(different);
  if (different < nodes.size())
    builder.fail(
        member,
        fmt::format("is a {} of {} different nodes: prism and pyramid are not supported", member.type().name, different),
        "mesh with hexahedra, or tetrahedra where they do not fit");
  fe::Element e = element_of(builder, member, fe::ElementType::solid, nodes);
  e.material = builder.material(member, member.element.material, true);
  e.group = builder.group(member, builder.parts.model.materials[fe::slot(e.material)].name);
  builder.parts.add_element(e);
}

const Node& node_of(const Builder& builder, long id) { return builder.parts.nodes.at(id); }

/// Axes of an element's nodes. @throws InputError where they differ
const Eigen::Matrix3d& axes_of(const Builder& builder, const Member& member) {
  const Eigen::Matrix3d& axes = node_of(builder, member.element.nodes.front()).axes;
  for (const long id : member.element.nodes)
    if (!node_of(builder, id).axes.isApprox(axes, 1e-9))
      builder.fail(member, "acts along the axes of its nodes, which are turned differently", "give them the same axes");
  return axes;
}

/// True where a displacement of the node is neither held nor without stiffness and mass of an element.
std::array<bool, 3> moving_directions(const Builder& builder, long id) {
  const fe::Model& model = builder.parts.model;
  const int node = builder.node(id);
  std::array<bool, 3> moves{};
  const bool whole =
      std::ranges::any_of(model.elements, [&](const fe::Element& e) { return contains(e.nodes, node); }) ||
      std::ranges::any_of(model.links, [&](const fe::RigidLink& l) { return l.master == node || l.slave == node; });
  moves.fill(whole);
  for (const fe::Spring& s : model.springs)
    for (std::size_t d = 0; d < 3; ++d)
      if ((s.node == node || s.node2 == node) && !s.rotation && s.direction[static_cast<int>(d)] != 0.0) moves[d] = true;
  for (const fe::Constraint& c : model.constraints) {
    if (c.node == node && c.direction < 3) moves[fe::slot(c.direction)] = true;
    for (const fe::Constraint::Term& term : c.terms)
      if (term.node == node && term.direction < 3) moves[fe::slot(term.direction)] = true;
  }
  for (const fe::Support& support : model.supports)
    for (std::size_t d = 0; d < 3; ++d) moves[d] = moves[d] && !(support.node == node && support.fixed[d]);
  return moves;
}

/// The direction that a COMBIN40 acts in, 1 to 6.
long direction_of(const TypeDefinition& type) { return std::max(1L, type.option(3)); }

/// A mass along the axes of node `id`. One number serves where the directions of another mass do not move.
void add_mass(Builder& builder, const Member& member, long id, const std::array<double, 3>& masses,
              const Eigen::Vector3d& inertia) {
  fe::PointMass mass{.group = builder.group(member, fmt::format("real_{}", member.element.real)), .node = builder.node(id)};
  mass.inertia_kg_m2 = inertia;
  const bool one = masses[0] == masses[1] && masses[0] == masses[2];
  const std::array<bool, 3> moves = one ? std::array{true, true, true} : moving_directions(builder, id);
  bool given = false;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!moves[d]) continue;
    if (given && masses[d] != mass.mass_kg)
      builder.fail(member,
                   fmt::format("has masses {:g}, {:g}, {:g} along x, y, z, and node {} moves in directions that differ",
                               masses[0], masses[1], masses[2], id),
                   "give one mass in all three directions, or hold the node in the others");
    mass.mass_kg = masses[d];
    given = true;
  }
  if (!given) mass.mass_kg = *std::ranges::max_element(masses);
  const Eigen::Matrix3d& axes = node_of(builder, id).axes;
  const auto turned = [&](const Eigen::Vector3d& v) {
    return !(axes.transpose() * v.asDiagonal() * axes).isApprox(v.asDiagonal().toDenseMatrix(), 1e-9);
  };
  if (turned(Eigen::Vector3d(masses.data())) || turned(inertia))
    builder.fail(member, "has a mass or inertia that differs by direction at a node whose axes are turned",
                 "give the node global axes, or one mass and inertia");
  if (mass.mass_kg < 0.0 || inertia.minCoeff() < 0.0)
    builder.parts.at(builder.reals(member).line, "R")
        .fail(fmt::format("set {} has a negative mass", member.element.real), "check the sign");
  builder.parts.model.masses.push_back(mass);
}

}  // namespace

void add_member(Builder& builder, const Member& member) {
  const Kind kind = member.type().kind;
  if (kind == Kind::bar) return add_bar(builder, member);
  if (kind == Kind::shell) return add_shell(builder, member);
  if (kind == Kind::solid) return add_solid(builder, member);
  add_beam(builder, member);
}

void add_spring(Builder& builder, const Member& member) {
  const TypeDefinition& type = member.definition;
  const RealSet& r = builder.reals(member);
  const std::string property = fmt::format("real_{}", member.element.real);
  fe::Spring s;
  s.group = builder.group(member, property);
  s.name = fmt::format("{}_{}", s.group, member.id);
  s.node = builder.node(member.element.nodes[0]);
  s.node2 = builder.node(member.element.nodes[1]);
  s.stiffness = r.at(1);
  s.damping = r.at(2);
  const bool combined = type.type->name == "COMBIN40";  // whose constants are K1, C, mass, gap, sliding force, K2
  const bool linear = combined ? r.at(4) == 0.0 && r.at(5) == 0.0 && r.at(6) == 0.0 : r.at(3) == 0.0;
  if (s.stiffness < 0.0 || s.damping < 0.0 || !linear)
    builder.parts.at(r.line, "R")
        .fail(fmt::format("set {} is no linear spring", member.element.real),
              combined ? "give stiffness and damping of 0 or more, no gap, no sliding force and no second spring"
                       : "give stiffness and damping of 0 or more, and no third constant");
  if (const long dof = combined ? direction_of(type) : type.option(2); dof > 0) {
    s.rotation = dof > 3;
    s.direction = axes_of(builder, member).row((dof - 1) % 3);
  } else {
    const long shape = type.option(3);  // 0 along the line, 1 about it, 2 along it in the X-Y plane
    s.rotation = shape == 1;
    s.direction = node_of(builder, member.element.nodes[1]).x_m - node_of(builder, member.element.nodes[0]).x_m;
    if (shape == 2) s.direction.z() = 0.0;
    if (!(s.direction.norm() > 0.0))
      builder.fail(member, "is a spring without length, so without direction", "give its direction by KEYOPT(2)");
    s.direction.normalize();
  }
  builder.parts.model.springs.push_back(s);
}

void add_masses(Builder& builder, const Member& member) {
  const RealSet& r = builder.reals(member);
  std::array<double, 3> masses = {r.at(1), r.at(1), r.at(1)};
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();
  if (member.type().kind == Kind::spring) {
    const std::size_t dof = fe::slot(static_cast<int>(direction_of(member.definition)) - 1);
    const double share = 0.5 * static_cast<double>(member.definition.option(6));  // of it at the second node
    for (std::size_t i = 0; i < 2; ++i) {
      const double mass = (i == 0 ? 1.0 - share : share) * r.at(3);
      masses = {};
      (dof < 3 ? masses[dof] : inertia[static_cast<int>(dof) - 3]) = mass;
      if (mass != 0.0) add_mass(builder, member, member.element.nodes[i], masses, inertia);
    }
    return;
  }
  const long shape = member.definition.option(3);
  if (shape == 0) {
    masses = {r.at(1), r.at(2), r.at(3)};
    inertia = {r.at(4), r.at(5), r.at(6)};
  } else if (shape == 3 || shape == 4) {
    masses[2] = 0.0;
    if (shape == 3) inertia.z() = r.at(2);
  }
  add_mass(builder, member, member.element.nodes[0], masses, inertia);
}

void add_supports(Builder& builder) {
  const Parts& parts = builder.parts;
  std::map<long, Hold> holds = parts.holds;
  for (const long id : builder.in_plane) {
    if (builder.in_space.contains(id))
      parts.at(0, fmt::format("node {}", id)).fail("joins a BEAM3 to elements in space", "use BEAM188 in the place of BEAM3");
    for (const std::size_t dof : {std::size_t{2}, std::size_t{3}, std::size_t{4}}) holds[id].fixed[dof] = true;
  }
  if (!builder.in_plane.empty()) builder.parts.note_once("BEAM3 is a beam in space whose nodes are held out of the X-Y plane");
  for (const auto& [id, hold] : holds)
    if (builder.has_node(id) && hold.fixed != std::array<bool, 6>{})
      builder.parts.hold_along(parts.at(hold.line, "D"), hold.name.empty() ? fmt::format("node_{}", id) : hold.name,
                               builder.node(id), node_of(builder, id).axes, hold.fixed);
}

}  // namespace twindeck::model_io::ansys
