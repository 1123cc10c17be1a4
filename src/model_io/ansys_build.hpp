#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>

#include "model_io/ansys_parts.hpp"

/// Inside of the library: the model while it is built out of Parts.
namespace twindeck::model_io::ansys {

/// An element with its number and its definition.
struct Member {
  long id;
  const Element& element;
  const TypeDefinition& definition;
  [[nodiscard]] const ElementType& type() const { return *definition.type; }
  /// Number of a type that decides what its real constants mean.
  [[nodiscard]] bool is(const std::string& name) const { return definition.type->name == name; }
  /// Node in the middle of a beam that may have one (BEAM189, PIPE289), or 0.
  [[nodiscard]] long middle() const {
    const bool may = is("BEAM189") || is("PIPE289");
    return may && element.nodes.size() > 2 ? element.nodes[2] : 0;
  }
};

/// What a section or a set of real constants says of an element.
struct CrossSection {
  fe::Section section;            ///< its name is that of the section, "section_2" or "real_2"
  long material = 0;              ///< that the section gives instead of the element's; 0: none
  Eigen::Vector2d node = {0, 0};  ///< of a beam: the node in the section's y and z, from the centroid [m]
  double turn_rad = 0.0;          ///< of a beam: of the section about the axis
  double initial_strain = 0.0;    ///< of beams and bars
};

class Builder {
 public:
  explicit Builder(Parts& p) : parts(p) {}

  Parts& parts;
  std::set<long> in_space;  ///< nodes of members other than plane beams
  std::set<long> in_plane;  ///< nodes of plane beams

  /// @throws InputError that names the element
  [[noreturn]] void fail(const Member& member, const std::string& problem, const std::string& mend) const;
  /// Makes the nodes of the model, in the order of their numbers. @throws InputError for one that is not defined
  void add_nodes();
  [[nodiscard]] int node(long id) const { return parts.node_position.at(id); }
  [[nodiscard]] bool has_node(long id) const { return parts.node_position.contains(id); }
  /// Position of a material, made when first asked for. @param isotropic  refuse one whose G does not follow from E and nu
  int material(const Member& member, long id, bool isotropic);
  /// Component of the element, or its type and `property`: "beam188_section_2".
  [[nodiscard]] std::string group(const Member& member, const std::string& property) const;
  [[nodiscard]] const RealSet& reals(const Member& member) const;

 private:
  std::map<long, int> materials_;
};

/// The member of an element.
/// @throws InputError  for a type that is not read, an option that is not, or the wrong number of nodes
[[nodiscard]] Member checked_member(const Parts& parts, long id, const Element& element);

/// Calls `visit(member)` for each element that is in the model, in the order of their numbers, after these checks.
template <class Visit>
void for_each_member(const Parts& parts, Visit visit) {
  for (const auto& [id, element] : parts.elements) {
    if (const Member member = checked_member(parts, id, element); member.type().kind != Kind::load) visit(member);
  }
}

}  // namespace twindeck::model_io::ansys
