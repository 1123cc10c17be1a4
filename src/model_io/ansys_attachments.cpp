#include "model_io/ansys_attachments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

/// Springs, masses and supports.
namespace twindeck::model_io::ansys {
namespace {

const Node& node_of(const Builder& builder, long id) { return builder.parts.nodes.at(id); }

void refuse_rotated(const Builder& builder, const Member& member, long id) {
  if (node_of(builder, id).rotated)
    builder.fail(member, fmt::format("acts along the axes of node {}, which are turned", id),
                 "turned nodal axes are not supported: give the node global axes");
}

/// True where a displacement of the node is neither held nor without stiffness and mass of an element.
std::array<bool, 3> moving_directions(const Builder& builder, long id) {
  const fe::Model& model = builder.parts.model;
  const int node = builder.node(id);
  std::array<bool, 3> moves{};
  const auto is_there = [&](const auto& nodes) { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); };
  const bool whole =
      std::any_of(model.elements.begin(), model.elements.end(), [&](const fe::Element& e) { return is_there(e.nodes); }) ||
      std::any_of(model.links.begin(), model.links.end(),
                  [&](const fe::RigidLink& l) { return l.master == node || l.slave == node; });
  moves.fill(whole);
  for (const fe::Spring& s : model.springs) {
    for (std::size_t d = 0; d < 3; ++d) {
      if ((s.node == node || s.node2 == node) && !s.rotation && s.direction[static_cast<int>(d)] != 0.0) moves[d] = true;
    }
  }
  for (const fe::Constraint& c : model.constraints) {
    if (c.node == node && c.direction < 3) moves[static_cast<std::size_t>(c.direction)] = true;
    for (const fe::Constraint::Term& term : c.terms) {
      if (term.node == node && term.direction < 3) moves[static_cast<std::size_t>(term.direction)] = true;
    }
  }
  for (const fe::Support& support : model.supports) {
    for (std::size_t d = 0; d < 3; ++d) moves[d] = moves[d] && !(support.node == node && support.fixed[d]);
  }
  return moves;
}

bool is_partial(const std::array<bool, 6>& fixed, std::size_t first) {
  return fixed[first] != fixed[first + 1] || fixed[first] != fixed[first + 2];
}

}  // namespace

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
  if (s.stiffness < 0.0 || s.damping < 0.0 || r.at(3) != 0.0)
    builder.parts.at(r.line, "R")
        .fail(fmt::format("set {} is no linear spring", member.element.real),
              "give stiffness and damping of 0 or more, and no third constant");
  if (const long dof = type.option(2); dof > 0) {
    for (const long id : member.element.nodes) refuse_rotated(builder, member, id);
    s.rotation = dof > 3;
    s.direction = Eigen::Vector3d::Unit((dof - 1) % 3);
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

void add_mass(Builder& builder, const Member& member) {
  const RealSet& r = builder.reals(member);
  const long id = member.element.nodes[0], shape = member.definition.option(3);
  std::array<double, 3> masses = {r.at(1), r.at(1), r.at(1)};
  fe::PointMass mass;
  mass.group = builder.group(member, fmt::format("real_{}", member.element.real));
  mass.node = builder.node(id);
  if (shape == 0) {
    masses = {r.at(1), r.at(2), r.at(3)};
    mass.inertia_kg_m2 = {r.at(4), r.at(5), r.at(6)};
  } else if (shape == 3 || shape == 4) {
    masses[2] = 0.0;
    if (shape == 3) mass.inertia_kg_m2.z() = r.at(2);
  }
  // One number serves where the directions of another mass do not move.
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
  if (!given) mass.mass_kg = *std::max_element(masses.begin(), masses.end());
  const Eigen::Vector3d& inertia = mass.inertia_kg_m2;
  if (node_of(builder, id).rotated && (inertia.x() != inertia.y() || inertia.x() != inertia.z()))
    refuse_rotated(builder, member, id);
  if (mass.mass_kg < 0.0 || inertia.minCoeff() < 0.0)
    builder.parts.at(r.line, "R").fail(fmt::format("set {} has a negative mass", member.element.real), "check the sign");
  builder.parts.model.masses.push_back(mass);
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
  for (const auto& [id, hold] : holds) {
    if (!builder.has_node(id) || hold.fixed == std::array<bool, 6>{}) continue;
    if (node_of(builder, id).rotated && (is_partial(hold.fixed, 0) || is_partial(hold.fixed, 3)))
      parts.at(hold.line, "D")
          .fail(fmt::format("holds node {} along axes that are turned, which is not supported", id),
                "give the node global axes, or hold it in all directions");
    builder.parts.hold(hold.name.empty() ? fmt::format("node_{}", id) : hold.name, builder.node(id), hold.fixed);
  }
}

}  // namespace twindeck::model_io::ansys
