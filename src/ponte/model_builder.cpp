#include "ponte/model_builder.hpp"

#include "core/error.hpp"

namespace twindeck::ponte {

int ModelBuilder::add_node(const Eigen::Vector3d& x_m) {
  model.nodes.push_back({std::ssize(model.nodes) + 1, x_m});
  return static_cast<int>(model.nodes.size()) - 1;
}

int ModelBuilder::add_material(const fe::Material& material) {
  const int index = static_cast<int>(model.materials.size());
  TWINDECK_ASSERT(materials_.emplace(material.name, index).second);
  model.materials.push_back(material);
  return index;
}

int ModelBuilder::add_section(const fe::Section& section) {
  const int index = static_cast<int>(model.sections.size());
  TWINDECK_ASSERT(sections_.emplace(section.name, index).second);
  model.sections.push_back(section);
  return index;
}

void ModelBuilder::add_element(fe::ElementType type, const std::string& section, const std::string& material,
                               std::vector<int> nodes, const Eigen::Vector3d& orientation) {
  model.elements.push_back({.id = std::ssize(model.elements) + 1,
                            .type = type,
                            .name = {},
                            .group = section,
                            .material = materials_.at(material),
                            .section = sections_.at(section),
                            .nodes = std::move(nodes),
                            .orientation = orientation});
}

void ModelBuilder::add_solid(const std::string& group, const std::string& material, std::vector<int> nodes) {
  model.elements.push_back({.id = std::ssize(model.elements) + 1,
                            .type = fe::ElementType::solid,
                            .name = {},
                            .group = group,
                            .material = materials_.at(material),
                            .nodes = std::move(nodes)});
}

void ModelBuilder::add_member(const std::string& section, int from, int to, int pieces, const Eigen::Vector3d& orientation,
                              const std::string& material) {
  const Eigen::Vector3d start = x(from), end = x(to);
  int last = from;
  for (int piece = 1; piece <= pieces; ++piece) {
    const int next = piece == pieces ? to : add_node(start + (end - start) * (static_cast<double>(piece) / pieces));
    add_element(fe::ElementType::beam, section, material, {last, next}, orientation);
    last = next;
  }
}

void ModelBuilder::add_spring(const std::string& group, const std::string& name, int node, const Eigen::Vector3d& direction,
                              double stiffness_N_m, int node2) {
  model.springs.push_back(
      {.name = name, .group = group, .node = node, .node2 = node2, .direction = direction, .stiffness = stiffness_N_m});
}

}  // namespace twindeck::ponte
