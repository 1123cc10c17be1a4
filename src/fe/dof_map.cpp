#include "fe/dof_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

namespace {

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

/// [-] of the distances from the origin: an arm this short is the rounding of coordinates, which files hold with 12 digits.
constexpr double no_arm = 1e-11;

/// Motion of the full degree of freedom 6·node + direction by those of its root: (root dof, factor).
std::vector<DofMap::Entry> rigid_motion(const Model& model, int full, int root) {
  const int node = full / 6, direction = full % 6;
  std::vector<DofMap::Entry> motion = {{6 * root + direction, 1.0}};
  if (node == root || direction > 2) return motion;
  const Eigen::Vector3d &end = model.nodes[slot(node)].x_m, &start = model.nodes[slot(root)].x_m;
  Eigen::Vector3d r = end - start;
  // Without this, an arm of rounding leads to a rotation that nothing else holds, and that turns so far that the slave is free.
  for (int i = 0; i < 3; ++i)
    if (std::abs(r[i]) <= no_arm * (end.norm() + start.norm())) r[i] = 0.0;
  const std::array<std::array<double, 3>, 3> cross = {{{0.0, r.z(), -r.y()}, {-r.z(), 0.0, r.x()}, {r.y(), -r.x(), 0.0}}};
  for (int j = 0; j < 3; ++j)
    if (cross[slot(direction)][slot(j)] != 0.0) motion.push_back({6 * root + 3 + j, cross[slot(direction)][slot(j)]});
  return motion;
}

/// Sums entries of one degree of freedom and drops what is rounding.
void merge(std::vector<DofMap::Entry>& entries) {
  constexpr double rounding = 1e-13;  ///< [-] of the largest factor: a sum of a few hundred factors is right to that
  std::map<int, double> sum;
  for (const DofMap::Entry& entry : entries) sum[entry.dof] += entry.factor;
  double largest = 0.0;
  for (const DofMap::Entry& entry : entries) largest = std::max(largest, std::abs(entry.factor));
  entries.clear();
  for (const auto& [dof, factor] : sum)
    if (std::abs(factor) > rounding * largest) entries.push_back({dof, factor});
}

/// Motion of every full degree of freedom by those that are neither a slave's nor dependent.
class Motions {
 public:
  Motions(const Model& model, const std::vector<int>& root) : model_(model), root_(root) {
    for (const Constraint& c : model.constraints) {
      const int full = 6 * c.node + c.direction;
      if (root[slot(c.node)] != c.node)
        refuse(c, "is the slave of a rigid link too", "let the constraint act on the master of the link");
      if (!dependent_.emplace(full, Dependent{&c, {}, State::untouched}).second)
        refuse(c, "depends by two constraints", "keep one of the two");
    }
    for (const Support& support : model.supports)
      for (int d = 0; d < 6; ++d)
        if (support.fixed[slot(d)] && dependent_.contains(6 * support.node + d))
          refuse(*dependent_.at(6 * support.node + d).by, "is held by a support too",
                 "take out one of the two, or support the nodes that it follows");
  }

  std::vector<DofMap::Entry> of(int full, int depth = 0) {
    std::vector<DofMap::Entry> motion = rigid_motion(model_, full, root_[slot(full / 6)]), whole;
    if (std::ranges::none_of(motion, [&](const auto& entry) { return dependent_.contains(entry.dof); })) return motion;
    for (const DofMap::Entry& entry : motion) {
      const auto found = dependent_.find(entry.dof);
      if (found == dependent_.end()) {
        whole.push_back(entry);
        continue;
      }
      for (const DofMap::Entry& under : resolve(found->second, depth))
        whole.push_back({under.dof, entry.factor * under.factor});
    }
    merge(whole);
    return whole;
  }

 private:
  enum class State { untouched, under_way, done };
  struct Dependent {
    const Constraint* by;
    std::vector<DofMap::Entry> motion;
    State state;
  };
  static constexpr int longest_chain = 200;  ///< constraints that hang on one another; real models have two or three

  const std::vector<DofMap::Entry>& resolve(Dependent& d, int depth) {
    if (d.state == State::done) return d.motion;
    if (d.state == State::under_way) refuse(*d.by, "depends on itself by other constraints", "take one of them out");
    if (depth > longest_chain)
      refuse(*d.by, "stands in a chain of more than 200 constraints", "let each follow nodes that follow no others");
    d.state = State::under_way;
    for (const Constraint::Term& term : d.by->terms)
      for (const DofMap::Entry& entry : of(6 * term.node + term.direction, depth + 1))
        d.motion.push_back({entry.dof, term.factor * entry.factor});
    merge(d.motion);
    d.state = State::done;
    return d.motion;
  }

  [[noreturn]] void refuse(const Constraint& c, const std::string& problem, const std::string& mend) const {
    constexpr std::array<const char*, 6> words = {"x", "y", "z", "rx", "ry", "rz"};
    throw InputError({model_.source, 0, "constraint " + c.name},
                     fmt::format("node {} in {} {}", id_of(model_, c.node), words[slot(c.direction)], problem), mend);
  }

  const Model& model_;
  const std::vector<int>& root_;
  std::map<int, Dependent> dependent_;  ///< by full degree of freedom
};

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

  // What reaches a slave, or what depends, reaches those degrees of freedom that move it.
  Motions motions(model, map.root);
  std::vector<std::vector<DofMap::Entry>> motion(slot(6 * n_nodes));
  std::vector<bool> active(slot(6 * n_nodes), false);
  for (int full = 0; full < 6 * n_nodes; ++full) {
    motion[slot(full)] = motions.of(full);
    if (!reached[slot(full)]) continue;
    for (const DofMap::Entry& entry : motion[slot(full)]) active[slot(entry.dof)] = true;
  }

  std::vector<int> number(slot(6 * n_nodes), -1);
  for (int full = 0; full < 6 * n_nodes; ++full) {
    if (!active[slot(full)] || fixed[slot(full)]) continue;
    const Node& node = model.nodes[slot(full / 6)];
    number[slot(full)] = static_cast<int>(map.dofs.size());
    map.dofs.push_back({std::to_string(node.id), full % 6, node.x_m});
    map.node_of.push_back(full / 6);
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
