#include "dynamics/doubtful_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace twindeck::dynamics {

namespace {

constexpr double kOnePlace = 1e-7;  ///< [-] of the size of the model: what rounding of coordinates leaves
constexpr std::size_t kMostNamedPairs = 3;

/// Nodes that move together by something that is no element.
class Joined {
 public:
  explicit Joined(const fe::Model& model) : to_(model.nodes.size()) {
    std::iota(to_.begin(), to_.end(), 0);
    for (const fe::RigidLink& link : model.links) join(link.master, link.slave);
    for (const fe::Spring& spring : model.springs) join(spring.node, spring.node2);
    for (const fe::Constraint& constraint : model.constraints)
      for (const fe::Constraint::Term& term : constraint.terms) join(constraint.node, term.node);
    for (const fe::MatrixElement& matrix : model.matrix_elements)
      for (const fe::MatrixElement::Dof& dof : matrix.dofs) join(matrix.dofs.front().node, dof.node);
  }
  [[nodiscard]] int root(int node) {
    int& to = to_[static_cast<std::size_t>(node)];
    return to == node ? node : to = root(to);
  }

 private:
  void join(int a, int b) {
    if (a >= 0 && b >= 0) to_[static_cast<std::size_t>(root(a))] = root(b);
  }
  std::vector<int> to_;
};

/// Elements by the nodes that they hold.
class Neighbours {
 public:
  explicit Neighbours(const fe::Model& model) : of_node_(model.nodes.size()) {
    for (const fe::Element& element : model.elements)
      for (const int node : element.nodes) of_node_[static_cast<std::size_t>(node)].push_back(&element);
  }
  /// Whether one element touches an element of either node: a hub within the body that it drives has no link to it either.
  [[nodiscard]] bool are_close(int a, int b) const {
    const std::set<int> of_a = about(a), of_b = about(b);
    for (const int node : of_a)
      for (const fe::Element* element : of_node_[static_cast<std::size_t>(node)])
        for (const int other : element->nodes)
          if (of_b.contains(other)) return true;
    return false;
  }

 private:
  /// Nodes of the elements that hold a node.
  [[nodiscard]] std::set<int> about(int node) const {
    std::set<int> nodes;
    for (const fe::Element* element : of_node_[static_cast<std::size_t>(node)])
      nodes.insert(element->nodes.begin(), element->nodes.end());
    return nodes;
  }
  std::vector<std::vector<const fe::Element*>> of_node_;
};

std::string listed(const std::vector<std::string>& pairs) {
  const std::size_t shown = std::min(pairs.size(), kMostNamedPairs);
  const std::string names =
      fmt::format("{}", fmt::join(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return pairs.size() > shown ? fmt::format("{} and {} pairs more", names, pairs.size() - shown) : names;
}

/// Pairs of nodes of elements at one place, each with the ids.
std::vector<std::string> loose_pairs(const fe::Model& model) {
  std::vector<int> held;
  for (const fe::Element& element : model.elements) held.insert(held.end(), element.nodes.begin(), element.nodes.end());
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  if (held.empty()) return {};
  const auto place = [&](int node) -> const Eigen::Vector3d& { return model.nodes[static_cast<std::size_t>(node)].x_m; };
  Eigen::Vector3d low = place(held.front()), high = low;
  for (const int node : held) low = low.cwiseMin(place(node)), high = high.cwiseMax(place(node));
  const double reach = kOnePlace * (high - low).norm();
  Joined joined(model);
  const Neighbours neighbours(model);
  std::vector<std::string> pairs;
  // Nodes by cells of twice the reach: a node at one place with another lies in its cell or in one beside it.
  std::map<std::tuple<long long, long long, long long>, std::vector<int>> cells;
  const double cell = std::max(2.0 * reach, 1e-300);
  for (const int node : held) {
    const Eigen::Vector3d at = (place(node) - low) / cell;
    bool found = false;
    for (int k = 0; k < 27 && !found; ++k) {
      const auto near = cells.find(
          {std::llround(at.x()) + k % 3 - 1, std::llround(at.y()) + k / 3 % 3 - 1, std::llround(at.z()) + k / 9 - 1});
      if (near == cells.end()) continue;
      for (const int other : near->second) {
        if ((place(node) - place(other)).norm() > reach || joined.root(node) == joined.root(other) ||
            neighbours.are_close(other, node))
          continue;
        pairs.push_back(fmt::format("{} and {}", model.nodes[static_cast<std::size_t>(other)].id,
                                    model.nodes[static_cast<std::size_t>(node)].id));
        found = true;
        break;
      }
    }
    cells[{std::llround(at.x()), std::llround(at.y()), std::llround(at.z())}].push_back(node);
  }
  return pairs;
}

std::vector<std::string> doubled_elements(const fe::Model& model) {
  std::map<std::tuple<fe::ElementType, int, int, std::vector<int>, std::vector<double>>, long> first;
  std::vector<std::string> pairs;
  for (const fe::Element& element : model.elements) {
    std::vector<int> nodes = element.nodes;
    std::sort(nodes.begin(), nodes.end());
    std::vector<double> offsets;
    for (const bool end : {nodes != element.nodes, nodes == element.nodes})
      offsets.insert(offsets.end(), element.offset_m[end].begin(), element.offset_m[end].end());
    const auto [at, is_new] =
        first.emplace(std::tuple(element.type, element.material, element.section, nodes, offsets), element.id);
    if (!is_new) pairs.push_back(fmt::format("{} and {}", at->second, element.id));
  }
  return pairs;
}

/// Tells of thick shells that are rigid in transverse shear. Shear lowers the first frequency of a square plate on supports by
/// 0.7 % at a width of twenty thicknesses, and by 2.8 % at ten.
std::string thick_shells(const fe::Model& model) {
  constexpr double thick = 15.0;  ///< [-] width of all shells over their thickness
  Eigen::AlignedBox3d box;
  const fe::Element* thickest = nullptr;
  const auto thickness = [&](const fe::Element& e) { return model.sections[fe::slot(e.section)].thickness_m; };
  for (const fe::Element& element : model.elements) {
    if (element.type != fe::ElementType::shell || element.section < 0) continue;
    for (const int node : element.nodes) box.extend(model.nodes[fe::slot(node)].x_m);
    if (model.formulation.shear_flexible && model.sections[fe::slot(element.section)].shear_thickness_ratio > 0.0) continue;
    if (thickest == nullptr || thickness(element) > thickness(*thickest)) thickest = &element;
  }
  if (thickest == nullptr || !(box.sizes().maxCoeff() < thick * thickness(*thickest))) return "";
  return fmt::format(
      "shells of group '{}' are {:.3g} m thick and all shells together {:.4g} m wide: they leave out transverse "
      "shear, which lowers frequencies by more than 1 %; give their section shear_thickness_ratio 0.8333, or use solids",
      thickest->group, thickness(*thickest), box.sizes().maxCoeff());
}

}  // namespace

std::vector<std::string> doubtful_mesh(const fe::Model& model) {
  std::vector<std::string> lines;
  if (std::string thick = thick_shells(model); !thick.empty()) lines.push_back(std::move(thick));
  if (const auto pairs = loose_pairs(model); !pairs.empty()) {
    lines.push_back(fmt::format(
        "nodes {} lie at one place and nothing joins them: the structure is cut there; give their elements one node, or a link",
        listed(pairs)));
  }
  if (const auto pairs = doubled_elements(model); !pairs.empty()) {
    lines.push_back(
        fmt::format("elements {} are the same (type, nodes, offsets, material and section): stiffness and mass count twice; "
                    "remove one of each pair",
                    listed(pairs)));
  }
  return lines;
}

}  // namespace twindeck::dynamics
