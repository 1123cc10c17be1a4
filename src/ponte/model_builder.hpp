#pragma once

#include <map>
#include <string>
#include <vector>

#include "fe/model.hpp"

namespace twindeck::ponte {

/// Collects the parts of the model under names; ids of nodes and elements count from 1 in the order of building.
class ModelBuilder {
 public:
  fe::Model model;

  int add_node(const Eigen::Vector3d& x_m);
  int add_material(const fe::Material& material);
  int add_section(const fe::Section& section);
  [[nodiscard]] const Eigen::Vector3d& x(int node) const { return model.nodes[static_cast<std::size_t>(node)].x_m; }

  /// An element; the group has the name of its section unless told otherwise.
  void add_element(fe::ElementType type, const std::string& section, const std::string& material, std::vector<int> nodes,
                   const Eigen::Vector3d& orientation = Eigen::Vector3d::Zero());
  /// A solid of eight nodes (see fe/solid.hpp for their order).
  void add_solid(const std::string& group, const std::string& material, std::vector<int> nodes);
  /// A straight member between two nodes, in `pieces` beams.
  void add_member(const std::string& section, int from, int to, int pieces,
                  const Eigen::Vector3d& orientation = Eigen::Vector3d::Zero(), const std::string& material = "steel");
  /// @param node2  the other end; -1: ground
  void add_spring(const std::string& group, const std::string& name, int node, const Eigen::Vector3d& direction,
                  double stiffness_N_m, int node2 = -1);

 private:
  std::map<std::string, int> materials_, sections_;
};

}  // namespace twindeck::ponte
