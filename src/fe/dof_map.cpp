#include "fe/dof_map.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

namespace {

using Rows = std::vector<std::vector<DofMap::Entry>>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

long id_of(const Model& model, int node) { return model.nodes[at(node)].id; }

/// The end of every node's chain of links.
std::vector<int> find_roots(const Model& model) {
  const int n = static_cast<int>(model.nodes.size());
  std::vector<int> master(at(n), -1), root(at(n), -1);
  for (const RigidLink& link : model.links) {
    if (master[at(link.slave)] >= 0)
      throw InputError({model.source, 0, "rigid link " + link.name},
                       fmt::format("node {} is the slave of two rigid links", id_of(model, link.slave)),
                       "let each node follow one master; link the masters to each other");
    master[at(link.slave)] = link.master;
  }
  for (int node = 0; node < n; ++node) {
    int end = node;
    for (int steps = 0; master[at(end)] >= 0; end = master[at(end)])
      if (++steps > n)
        throw InputError({model.source, 0, "rigid links"},
                         fmt::format("the links that start at node {} lead round in a circle", id_of(model, node)),
                         "take out one link so that every chain ends at a master that is no slave");
    root[at(node)] = end;
  }
  return root;
}

std::vector<bool> find_fixed(const Model& model, const std::vector<int>& root) {
  std::vector<bool> fixed(6 * model.nodes.size(), false);
  for (const Support& support : model.supports)
    for (int d = 0; d < 6; ++d) {
      if (!support.fixed[at(d)]) continue;
      if (root[at(support.node)] != support.node)
        throw InputError(
            {model.source, 0, "support " + support.name},
            fmt::format("node {} is held by a support and is the slave of a rigid link", id_of(model, support.node)),
            fmt::format("support its master, node {}, or use a stiff spring", id_of(model, root[at(support.node)])));
      fixed[at(6 * support.node + d)] = true;
    }
  return fixed;
}

/// Motion of node `node` by the six degrees of freedom of its root: (root dof, factor) for each of its six directions.
std::array<std::vector<DofMap::Entry>, 6> rigid_motion(const Model& model, int node, int root) {
  std::array<std::vector<DofMap::Entry>, 6> motion;
  for (int d = 0; d < 6; ++d) motion[at(d)].push_back({6 * root + d, 1.0});
  if (node == root) return motion;
  const Eigen::Vector3d r = model.nodes[at(node)].x_m - model.nodes[at(root)].x_m;
  const std::array<std::array<double, 3>, 3> cross = {{{0.0, r.z(), -r.y()}, {-r.z(), 0.0, r.x()}, {r.y(), -r.x(), 0.0}}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (cross[at(i)][at(j)] != 0.0) motion[at(i)].push_back({6 * root + 3 + j, cross[at(i)][at(j)]});
  return motion;
}

/// Full degrees of freedom that elements, springs or rotary masses reach.
std::vector<bool> find_reached(const Model& model) {
  std::vector<bool> reached(6 * model.nodes.size(), false);
  for (const Element& element : model.elements) {
    const int count = element.type == ElementType::beam || element.type == ElementType::shell ? 6 : 3;
    for (const int node : element.nodes)
      for (int d = 0; d < count; ++d) reached[at(6 * node + d)] = true;
  }
  for (const Spring& spring : model.springs) {
    if (!carries_stiffness(spring)) continue;
    for (const int node : {spring.node, spring.node2})
      for (int d = 0; node >= 0 && d < 3; ++d)
        if (spring.direction[d] != 0.0) reached[at(6 * node + (spring.rotation ? 3 : 0) + d)] = true;
  }
  for (const MatrixElement& element : model.matrix_elements)
    for (const MatrixElement::Dof& dof : element.dofs) reached[at(6 * dof.node + dof.direction)] = true;
  for (const PointMass& mass : model.masses)
    for (int d = 0; d < 3; ++d)
      if (mass.inertia_kg_m2[d] != 0.0) reached[at(6 * mass.node + 3 + d)] = true;
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
  Rows motion(at(6 * n_nodes));
  std::vector<bool> active(at(6 * n_nodes), false);
  for (int node = 0; node < n_nodes; ++node) {
    auto six = rigid_motion(model, node, map.root[at(node)]);
    for (int d = 0; d < 6; ++d) {
      if (reached[at(6 * node + d)])
        for (const DofMap::Entry& entry : six[at(d)]) active[at(entry.dof)] = true;
      motion[at(6 * node + d)] = std::move(six[at(d)]);
    }
  }

  std::vector<int> number(at(6 * n_nodes), -1);
  for (int full = 0; full < 6 * n_nodes; ++full) {
    if (!active[at(full)] || fixed[at(full)]) continue;
    const Node& node = model.nodes[at(full / 6)];
    number[at(full)] = static_cast<int>(map.dofs.size());
    map.dofs.push_back({std::to_string(node.id), full % 6, node.x_m});
  }

  map.rows.resize(at(6 * n_nodes));
  std::vector<Eigen::Triplet<double, int>> triplets;
  for (int full = 0; full < 6 * n_nodes; ++full)
    for (const DofMap::Entry& entry : motion[at(full)])
      if (number[at(entry.dof)] >= 0) {
        map.rows[at(full)].push_back({number[at(entry.dof)], entry.factor});
        triplets.emplace_back(full, number[at(entry.dof)], entry.factor);
      }
  map.expansion.resize(6 * n_nodes, static_cast<Eigen::Index>(map.dofs.size()));
  map.expansion.setFromTriplets(triplets.begin(), triplets.end());
  return map;
}

}  // namespace twindeck::fe
