#include "fe/dof_map.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

namespace {

using Rows = std::vector<std::vector<DofMap::Entry>>;

long id_of(const Model& model, int node) { return model.nodes[slot(node)].id; }

/// The end of every node's chain of links.
std::vector<int> find_roots(const Model& model) {
  const int n = static_cast<int>(model.nodes.size());
  std::vector<int> master(slot(n), -1), root(slot(n), -1);
  for (const RigidLink& link : model.links) {
    if (master[slot(link.slave)] >= 0)
      throw InputError({model.source, 0, "rigid link " + link.name},
                       fmt::format("node {} is the slave of two rigid links", id_of(model, link.slave)),
                       "let each node follow one master; link the masters to each other");
    master[slot(link.slave)] = link.master;
  }
  for (int node = 0; node < n; ++node) {
    int end = node;
    for (int steps = 0; master[slot(end)] >= 0; end = master[slot(end)])
      if (++steps > n)
        throw InputError({model.source, 0, "rigid links"},
                         fmt::format("the links that start at node {} lead round in a circle", id_of(model, node)),
                         "take out one link so that every chain ends at a master that is no slave");
    root[slot(node)] = end;
  }
  return root;
}

std::vector<bool> find_fixed(const Model& model, const std::vector<int>& root) {
  std::vector<bool> fixed(6 * model.nodes.size(), false);
  for (const Support& support : model.supports)
    for (int d = 0; d < 6; ++d) {
      if (!support.fixed[slot(d)]) continue;
      if (root[slot(support.node)] != support.node)
        throw InputError(
            {model.source, 0, "support " + support.name},
            fmt::format("node {} is held by a support and is the slave of a rigid link", id_of(model, support.node)),
            fmt::format("support its master, node {}, or use a stiff spring", id_of(model, root[slot(support.node)])));
      fixed[slot(6 * support.node + d)] = true;
    }
  return fixed;
}

/// Motion of node `node` by the six degrees of freedom of its root: (root dof, factor) for each of its six directions.
std::array<std::vector<DofMap::Entry>, 6> rigid_motion(const Model& model, int node, int root) {
  std::array<std::vector<DofMap::Entry>, 6> motion;
  for (int d = 0; d < 6; ++d) motion[slot(d)].push_back({6 * root + d, 1.0});
  if (node == root) return motion;
  const Eigen::Vector3d r = model.nodes[slot(node)].x_m - model.nodes[slot(root)].x_m;
  const std::array<std::array<double, 3>, 3> cross = {{{0.0, r.z(), -r.y()}, {-r.z(), 0.0, r.x()}, {r.y(), -r.x(), 0.0}}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (cross[slot(i)][slot(j)] != 0.0) motion[slot(i)].push_back({6 * root + 3 + j, cross[slot(i)][slot(j)]});
  return motion;
}

/// Full degrees of freedom that elements, springs or rotary masses reach.
std::vector<bool> find_reached(const Model& model) {
  std::vector<bool> reached(6 * model.nodes.size(), false);
  for (const Element& element : model.elements) {
    const int count = element.type == ElementType::beam || element.type == ElementType::shell ? 6 : 3;
    for (const int node : element.nodes)
      for (int d = 0; d < count; ++d) reached[slot(6 * node + d)] = true;
  }
  for (const Spring& spring : model.springs) {
    if (!carries_stiffness(spring)) continue;
    for (const int node : {spring.node, spring.node2})
      for (int d = 0; node >= 0 && d < 3; ++d)
        if (spring.direction[d] != 0.0) reached[slot(6 * node + (spring.rotation ? 3 : 0) + d)] = true;
  }
  for (const MatrixElement& element : model.matrix_elements)
    for (const MatrixElement::Dof& dof : element.dofs) reached[slot(6 * dof.node + dof.direction)] = true;
  for (const PointMass& mass : model.masses)
    for (int d = 0; d < 3; ++d)
      if (mass.inertia_kg_m2[d] != 0.0) reached[slot(6 * mass.node + 3 + d)] = true;
  return reached;
}

}  // namespace

DofMap make_dof_map(const Model& model) {
  DofMap map;
  map.root = find_roots(model);
  const std::vector<bool> fixed = find_fixed(model, map.root);
  const std::vector<bool> reached = find_reached(model);
  const int n_nodes = static_cast<int>(model.nodes.size());

  // What reaches a slave reaches those of its root's degrees of freedom that move it.
  Rows motion(slot(6 * n_nodes));
  std::vector<bool> active(slot(6 * n_nodes), false);
  for (int node = 0; node < n_nodes; ++node) {
    auto six = rigid_motion(model, node, map.root[slot(node)]);
    for (int d = 0; d < 6; ++d) {
      if (reached[slot(6 * node + d)])
        for (const DofMap::Entry& entry : six[slot(d)]) active[slot(entry.dof)] = true;
      motion[slot(6 * node + d)] = std::move(six[slot(d)]);
    }
  }

  std::vector<int> number(slot(6 * n_nodes), -1);
  for (int full = 0; full < 6 * n_nodes; ++full) {
    if (!active[slot(full)] || fixed[slot(full)]) continue;
    const Node& node = model.nodes[slot(full / 6)];
    number[slot(full)] = static_cast<int>(map.dofs.size());
    map.dofs.push_back({std::to_string(node.id), full % 6, node.x_m});
  }

  map.rows.resize(slot(6 * n_nodes));
  std::vector<Eigen::Triplet<double, int>> triplets;
  for (int full = 0; full < 6 * n_nodes; ++full)
    for (const DofMap::Entry& entry : motion[slot(full)])
      if (number[slot(entry.dof)] >= 0) {
        map.rows[slot(full)].push_back({number[slot(entry.dof)], entry.factor});
        triplets.emplace_back(full, number[slot(entry.dof)], entry.factor);
      }
  map.expansion.resize(6 * n_nodes, static_cast<Eigen::Index>(map.dofs.size()));
  map.expansion.setFromTriplets(triplets.begin(), triplets.end());
  return map;
}

}  // namespace twindeck::fe
