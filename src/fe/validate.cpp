#include "fe/validate.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/matrix_element.hpp"
#include "fe/validate_parts.hpp"

namespace twindeck::fe {

namespace {

constexpr double farthest_m = 1e9;     ///< of a node from the origin, whatever the grid: beyond, differences are lost
constexpr double least_across = 1e-9;  ///< [-] part of an orientation that lies across its beam, as in beam_axes

constexpr double flattest_triangle = 1e-10;  ///< [-] twice the area over the squares of its sides, as in shell_triangle.cpp

/// Whether a solid is sound once its two faces have changed places.
bool solid_turned_is_sound(const Model& model, const Element& e) {
  SolidGeometry turned = solid_geometry(model, e);
  for (std::size_t i = 0; i < 4; ++i) std::swap(turned.node_m[i], turned.node_m[i + 4]);
  return is_sound(solid_shape(turned));
}

std::string label(const Element& e) { return fmt::format("element {}{}", e.id, e.name.empty() ? "" : " (" + e.name + ")"); }

std::string nodes_of_solid(const Model& model, const Element& e) {
  std::vector<long> ids;
  for (const int node : e.nodes) ids.push_back(model.nodes[static_cast<std::size_t>(node)].id);
  return fmt::format("the solid {}", fmt::join(ids, "-"));
}

std::string is_inverted(double volume_m3) { return fmt::format(" is inverted: its volume is {:.6g} m3", volume_m3); }

/// A hexahedron, or a quadratic solid, that is inside out, flat or folded.
void check_solid(const Model& model, const Element& e) {
  const bool quadratic = is_quadratic(e);
  const SolidShape shape = quadratic ? quadratic_solid_shape(quadratic_solid(model, e)) : solid_shape(solid_geometry(model, e));
  if (is_sound(shape)) return;
  const std::string solid = nodes_of_solid(model, e);
  const std::string mend = quadratic ? "give the corners first, then the nodes in the middles of their edges"
                                     : "give four nodes round one face, then the four above them in the same order";
  if (shape.volume_m3 == 0.0) refuse(model, label(e), solid + " has no volume", mend);
  if (shape.volume_m3 < 0.0 && !quadratic && solid_turned_is_sound(model, e))
    refuse(model, label(e), solid + is_inverted(shape.volume_m3),
           "its faces run the wrong way round: give nodes 5-8 first, then 1-4");
  refuse(model, label(e),
         solid + fmt::format(" is folded or flat near node {}: the Jacobian there is {:.3g} of the element's mean, expected a "
                             "positive part of it (volume {:.6g} m3)",
                             model.nodes[slot(e.nodes[slot(shape.least_corner)])].id, shape.least_ratio, shape.volume_m3),
         mend);
}

/// A tetrahedron that is inside out or flat.
void check_tetrahedron(const Model& model, const Element& e) {
  const double volume = tetrahedron_volume(tetrahedron_geometry(model, e));
  if (volume > 0.0) return;
  const std::string solid = nodes_of_solid(model, e);
  if (volume == 0.0) refuse(model, label(e), solid + " has no volume", "give four nodes that do not lie in one plane");
  refuse(model, label(e), solid + is_inverted(volume),
         "exchange two of its first three nodes: they go round anticlockwise as seen from the fourth");
}

/// A position in one of the model's lists; `what` says which ("material").
void require_position(const Model& model, const std::string& part, const char* what, int position, std::size_t count) {
  if (position >= 0 && static_cast<std::size_t>(position) < count) return;
  refuse(
      model, part,
      fmt::format("{} has number {} in the list of {}, expected 0 to {}", what, position, count, static_cast<long>(count) - 1),
      fmt::format("give the {} of this part", what));
}

void check_element(const Model& model, const Element& e) {
  require_position(model, label(e), "material", e.material, model.materials.size());
  if (e.type != ElementType::solid) require_position(model, label(e), "section", e.section, model.sections.size());
  if (e.section2 != -1) {
    require_position(model, label(e), "second section", e.section2, model.sections.size());
    if (e.type != ElementType::beam)
      refuse(model, label(e), "has a section at its second end, but is no beam", "leave the second section out");
  }
  if (e.pull_N != 0.0 && e.type != ElementType::stay && e.type != ElementType::bar)
    refuse(model, label(e), fmt::format("has a pull of {:g} N, but is neither stay nor bar", e.pull_N), "leave the pull out");
  if (!has_node_count(e.type, e.nodes.size()))
    refuse(model, label(e),
           fmt::format("has {} nodes, expected {}", e.nodes.size(),
                       e.type == ElementType::shell   ? "3 or 4"
                       : e.type == ElementType::solid ? "4, 8, 10 or 20"
                                                      : "2"),
           "beams, bars and stays join two nodes, shells three or four, solids four, eight, ten or twenty");
  for (const int node : e.nodes) require_position(model, label(e), "node", node, model.nodes.size());
  if (std::set<int>(e.nodes.begin(), e.nodes.end()).size() != e.nodes.size())
    refuse(model, label(e), "names the same node twice", "give different nodes");
}

void check_nodes(const Model& model) {
  std::set<long> ids;
  for (const Node& node : model.nodes) {
    if (!ids.insert(node.id).second)
      refuse(model, fmt::format("node {}", node.id), "this id is used twice", "give every node its own id");
    if (!(node.x_m.cwiseAbs().maxCoeff() <= farthest_m))
      refuse(model, fmt::format("node {}", node.id),
             fmt::format("lies at ({:g}, {:g}, {:g}) m, expected coordinates of at most {:g} m", node.x_m.x(), node.x_m.y(),
                         node.x_m.z(), farthest_m),
             "give x, y, z in metres");
  }
}

void check_springs(const Model& model) {
  const std::size_t n = model.nodes.size();
  for (const Spring& s : model.springs) {
    const std::string part = "spring " + s.name;
    require_position(model, part, "node", s.node, n);
    if (s.node2 != -1) require_position(model, part, "second node", s.node2, n);
    if (s.node == s.node2) refuse(model, part, "joins a node to itself", "leave the second node out for a spring to ground");
    if (!(s.direction.norm() > 1e-12)) refuse(model, part, "has no direction", "give the direction in which it acts");
    if (!(s.stiffness >= 0.0) || !(s.damping >= 0.0) || !(s.friction_N >= 0.0))
      refuse(
          model, part,
          fmt::format("stiffness {:g}, damping {:g}, friction {:g}: expected 0 or more", s.stiffness, s.damping, s.friction_N),
          "take out the negative value");
  }
}

void check_constraints(const Model& model) {
  for (const Constraint& c : model.constraints) {
    const std::string part = "constraint " + c.name;
    require_position(model, part, "node", c.node, model.nodes.size());
    require_position(model, part, "direction", c.direction, 6);
    if (c.terms.empty()) refuse(model, part, "follows nothing", "name the displacements that it follows, or use a support");
    for (const Constraint::Term& term : c.terms) {
      require_position(model, part, "node of a term", term.node, model.nodes.size());
      require_position(model, part, "direction of a term", term.direction, 6);
      if (!(std::abs(term.factor) <= farthest_m))
        refuse(model, part, fmt::format("has a factor of {:g}, expected at most {:g}", term.factor, farthest_m),
               "give the share of the displacement that it follows");
    }
  }
  if (!model.constraints.empty() && model.prestress.displacements == Displacements::large)
    refuse(model, "constraint " + model.constraints.front().name,
           "holds for small displacements, but the dead load is to be found with large ones",
           "set displacements = \"linear\", or use rigid links");
}

void check_attachments(const Model& model) {
  const std::size_t n = model.nodes.size();
  for (const RigidLink& link : model.links) {
    const std::string part = "rigid link " + link.name;
    require_position(model, part, "master", link.master, n);
    require_position(model, part, "slave", link.slave, n);
    if (link.master == link.slave) refuse(model, part, "links a node to itself", "give two different nodes");
  }
  check_constraints(model);
  for (const PointMass& mass : model.masses) {
    require_position(model, "point mass of group '" + mass.group + "'", "node", mass.node, n);
    if (!(mass.mass_kg >= 0.0) || !(mass.inertia_kg_m2.minCoeff() >= 0.0))
      refuse(model, "point mass of group '" + mass.group + "'",
             fmt::format("mass is {:g} kg with a least inertia of {:g} kg m2, expected 0 or more", mass.mass_kg,
                         mass.inertia_kg_m2.minCoeff()),
             "take out the negative value");
  }
  for (const Support& support : model.supports) require_position(model, "support " + support.name, "node", support.node, n);
}

/// The loads of the static stage and the strains without forces.
void check_stage(const Model& model) {
  const Prestress& p = model.prestress;
  const bool large = p.displacements == Displacements::large;
  for (const Prestress::Load& load : p.loads) {
    require_position(model, "load case " + p.load_case, "node", load.node, model.nodes.size());
    require_position(model, "load case " + p.load_case, "direction", load.direction, load.movement ? 3 : 6);
    if (large && load.movement)
      refuse(model, "load case " + p.load_case, "moves a support, which is not computed with large displacements",
             "set displacements = \"linear\", or load by forces");
  }
  if (!p.loads.empty() && p.rule == PullRule::none)
    refuse(model, "prestress", fmt::format("its load case '{}' does not act, since its rule is none", p.load_case),
           "set rule = \"given\"");
  for (const Element& e : model.elements) {
    if (e.free_strain == 0.0) continue;
    if (e.type == ElementType::stay)
      refuse(model, label(e), "has a free strain, but a stay takes its force from its pull", "give the pull");
    if (p.rule == PullRule::none)
      refuse(model, label(e), "has a free strain, but the prestress has the rule none", "set rule = \"given\"");
    if (large && e.type != ElementType::bar)
      refuse(model, label(e), "has a free strain, which is computed with large displacements for bars alone",
             "set displacements = \"linear\"");
  }
  if (!(std::abs(model.gravity_direction.norm() - 1.0) < 1e-6))
    refuse(model, "gravity_direction", fmt::format("has the length {:g}, expected 1", model.gravity_direction.norm()),
           "give a unit vector");
}

void check_prestress(const Model& model) {
  check_stage(model);
  const Prestress& p = model.prestress;
  bool has_stay = false;
  for (const Element& e : model.elements) {
    if (e.type != ElementType::stay) continue;
    has_stay = true;
    if (p.rule == PullRule::given && !(e.pull_N > 0.0))
      refuse(model, label(e), fmt::format("the pull is {:g} N, expected a positive force", e.pull_N),
             "give the pull of each stay, or let shape finding find them");
  }
  if (p.rule != PullRule::shape_finding) return;
  for (const auto& condition : p.conditions) {
    require_position(model, "prestress condition", "node", condition.node, model.nodes.size());
    require_position(model, "prestress condition", "direction", condition.dof, 3);
  }
  if (!has_stay) refuse(model, "prestress", "shape finding needs stays, the model has none", "set the rule to none");
  if (p.conditions.empty())
    refuse(model, "prestress", "shape finding has no displacement to bring to zero", "list the nodes and directions");
  if (!(p.minimum_pull_N > 0.0) || !(p.ridge > 0.0) || !(p.site_weight >= 0.0))
    refuse(model, "prestress",
           fmt::format("minimum pull {:g} N and ridge {:g} must be positive, site weight {:g} not negative", p.minimum_pull_N,
                       p.ridge, p.site_weight),
           "give values in those ranges");
}

/// The vector that turns a beam's section about its axis.
void check_orientation(const Model& model, const Element& e, const Eigen::Vector3d& axis) {
  if (e.type != ElementType::beam || e.orientation.isZero(0.0)) return;
  const Eigen::Vector3d direction = e.orientation.normalized();
  if (direction.cross(axis.normalized()).norm() > least_across) return;
  refuse(model, label(e),
         fmt::format("its orientation ({:g}, {:g}, {:g}) lies along the beam, expected a vector across it", e.orientation.x(),
                     e.orientation.y(), e.orientation.z()),
         "give an orientation that is not parallel to the beam, or 0 0 0 for the default");
}

}  // namespace

void validate_references(const Model& model) {
  check_nodes(model);
  for (const Element& e : model.elements) check_element(model, e);
  check_springs(model);
  validate_matrix_elements(model);
  check_attachments(model);
  check_prestress(model);
}

void validate_geometry(const Model& model) {
  std::vector<bool> reached(model.nodes.size(), false);
  const auto reach = [&](int node) { reached[static_cast<std::size_t>(node)] = true; };
  for (const Element& e : model.elements) {
    for (const int node : e.nodes) reach(node);
    const auto id = [&](std::size_t i) { return model.nodes[static_cast<std::size_t>(e.nodes[i])].id; };
    if (is_triangle(e)) {
      const auto x = triangle_geometry(model, e).node_m;
      const double squares = (x[1] - x[0]).squaredNorm() + (x[2] - x[1]).squaredNorm() + (x[0] - x[2]).squaredNorm();
      if (!((x[1] - x[0]).cross(x[2] - x[0]).norm() > flattest_triangle * squares))
        refuse(model, label(e), fmt::format("the shell {}-{}-{} has no area", id(0), id(1), id(2)),
               "give three nodes that do not lie on one line, anticlockwise");
      continue;
    }
    if (e.type == ElementType::shell) {
      const auto x = shell_geometry(model, e).node_m;
      const double twice_area = (x[2] - x[0]).cross(x[3] - x[1]).norm();
      if (!(twice_area > 1e-12 * (x[2] - x[0]).squaredNorm()))
        refuse(model, label(e), fmt::format("the shell {}-{}-{}-{} has no area", id(0), id(1), id(2), id(3)),
               "give its four nodes anticlockwise");
      continue;
    }
    if (e.type == ElementType::solid) {
      is_tetrahedron(e) ? check_tetrahedron(model, e) : check_solid(model, e);
      continue;
    }
    const auto ends = end_nodes(model, e);
    Eigen::Vector3d chord = ends[1] - ends[0];
    check_orientation(model, e, chord + e.offset_m[1] - e.offset_m[0]);
    if (e.type == ElementType::beam) chord += e.offset_m[1] - e.offset_m[0];
    if (!(chord.norm() > 1e-9))
      refuse(model, label(e), fmt::format("nodes {} and {} are at the same place, so the member has no length", id(0), id(1)),
             "join them by a rigid link, merge them, or take the element out");
  }
  for (const Spring& spring : model.springs) {
    if (!carries_stiffness(spring)) continue;
    reach(spring.node);
    if (spring.node2 >= 0) reach(spring.node2);
  }
  for (const MatrixElement& element : model.matrix_elements)
    for (const MatrixElement::Dof& dof : element.dofs) reach(dof.node);
  for (const RigidLink& link : model.links) reach(link.slave), reach(link.master);
  for (const Constraint& c : model.constraints) {
    reach(c.node);
    for (const Constraint::Term& term : c.terms) reach(term.node);
  }
  for (const Support& support : model.supports) reach(support.node);
  for (std::size_t i = 0; i < reached.size(); ++i)
    if (!reached[i])
      refuse(model, fmt::format("node {}", model.nodes[i].id), "no element, spring, link or support reaches this node",
             "join it to the structure or take it out");
}

void validate(const Model& model) {
  if (model.nodes.empty() || (model.elements.empty() && model.springs.empty() && model.matrix_elements.empty()))
    refuse(model, "model",
           fmt::format("has {} nodes, {} elements and {} springs", model.nodes.size(), model.elements.size(),
                       model.springs.size()),
           "a model needs nodes and something that joins them");
  validate_references(model);
  validate_properties(model);
  validate_geometry(model);
  validate_parameters(model);
}

}  // namespace twindeck::fe
