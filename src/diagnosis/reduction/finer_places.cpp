#include "diagnosis/reduction/finer_places.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>

#include "diagnosis/reduction/place_parts.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Positions of the elements that a place is made of. A parameter's place names none; those of its material are its own.
std::vector<int> elements_of(const Structure& structure, const Place& place) {
  const auto parameter = place.attributes.find("parameter");
  if (!place.elements.empty() || parameter == place.attributes.end()) return place.elements;
  const fe::Model& model = *structure.model;
  const fe::Parameter& scaled = structure.system->parameters[static_cast<std::size_t>(parameter->second)];
  std::vector<int> out;
  if (scaled.target != fe::Target::youngs_modulus) return out;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const int material = model.elements[e].material;
    if (material < 0) continue;
    const std::string& name = model.materials[static_cast<std::size_t>(material)].name;
    if (std::find(scaled.of.begin(), scaled.of.end(), name) != scaled.of.end()) out.push_back(static_cast<int>(e));
  }
  return out;
}

Vector3d middle_of_element(const fe::Model& model, int e) {
  const fe::Element& element = model.elements[static_cast<std::size_t>(e)];
  Vector3d sum = Vector3d::Zero();
  for (const int node : element.nodes) sum += model.nodes[static_cast<std::size_t>(node)].x_m;
  return sum / static_cast<double>(element.nodes.size());
}

/// Direction in which points lie farthest apart.
Vector3d longest_direction(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& x : points) mean += x / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3d& x : points) spread += (x - mean) * (x - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
}

}  // namespace

NodeGraph::NodeGraph(const Structure& structure) {
  const fe::ParametricSystem& system = *structure.system;
  std::vector<int> node_of;
  std::vector<Vector3d> where;
  for (const fe::DofLabel& dof : system.dofs) {
    const auto [at, is_new] = positions_.try_emplace(dof.node, static_cast<int>(names_.size()));
    if (is_new) {
      names_.push_back(dof.node);
      where.push_back(dof.x_m);
    }
    node_of.push_back(at->second);
  }
  std::set<std::pair<int, int>> joined;
  for (int c = 0; c < system.pattern.outerSize(); ++c)
    for (linalg::SparseMatrix::InnerIterator entry(system.pattern, c); entry; ++entry) {
      const int a = node_of[static_cast<std::size_t>(entry.row())], b = node_of[static_cast<std::size_t>(c)];
      if (a != b) joined.emplace(std::min(a, b), std::max(a, b));
    }
  edges_.resize(names_.size());
  for (const auto& [a, b] : joined) {
    const double distance = (where[static_cast<std::size_t>(a)] - where[static_cast<std::size_t>(b)]).norm();
    const double length = std::isfinite(distance) ? distance : 1.0;
    edges_[static_cast<std::size_t>(a)].emplace_back(b, length);
    edges_[static_cast<std::size_t>(b)].emplace_back(a, length);
  }
}

int NodeGraph::position(const std::string& name) const {
  const auto found = positions_.find(name);
  return found == positions_.end() ? -1 : found->second;
}

std::vector<NodeGraph::Reached> NodeGraph::reached_from(const std::vector<int>& located) const {
  std::vector<Reached> out(names_.size(), Reached{kFar, -1, -1});
  using Step = std::pair<double, int>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> next;
  for (const int at : located) {
    out[static_cast<std::size_t>(at)] = {0.0, at, -1};
    next.emplace(0.0, at);
  }
  while (!next.empty()) {
    const auto [length, at] = next.top();
    next.pop();
    if (length > out[static_cast<std::size_t>(at)].length) continue;
    for (const auto& [other, edge] : edges_[static_cast<std::size_t>(at)]) {
      Reached& there = out[static_cast<std::size_t>(other)];
      if (!(length + edge < there.length)) continue;
      there = {length + edge, out[static_cast<std::size_t>(at)].owner, at};
      next.emplace(there.length, other);
    }
  }
  return out;
}

/// The way goes back from `from` to its location, and over the edge to `to` and its location.
int NodeGraph::middle_of_way(const std::vector<Reached>& reached, int from, int to) const {
  const auto at = [&](int node) -> const Reached& { return reached[static_cast<std::size_t>(node)]; };
  double edge = kFar;
  for (const auto& [other, length] : edges_[static_cast<std::size_t>(from)])
    if (other == to) edge = std::min(edge, length);
  const double half = 0.5 * (at(from).length + edge + at(to).length), way = 2.0 * half;
  int middle = -1;
  double off = kFar;
  const auto look = [&](int node, double along) {
    if (at(node).before < 0 || !(std::abs(along - half) < off)) return;  // a location itself is none between them
    off = std::abs(along - half);
    middle = node;
  };
  for (int node = from; node >= 0; node = at(node).before) look(node, at(node).length);
  for (int node = to; node >= 0; node = at(node).before) look(node, way - at(node).length);
  return middle;
}

std::vector<std::string> NodeGraph::between(const std::string& centre, const std::vector<std::string>& located) const {
  std::vector<int> sources;
  for (const std::string& name : located)
    if (const int at = position(name); at >= 0) sources.push_back(at);
  const int own = position(centre);
  if (own < 0) return {};
  const std::vector<Reached> reached = reached_from(sources);
  struct Border {
    double length;
    int from, to;
  };
  std::map<int, Border> borders;  // by the location on the other side
  double farthest = 0.0;
  int far_node = -1;
  for (std::size_t n = 0; n < names_.size(); ++n) {
    if (reached[n].owner != own) continue;
    if (reached[n].length > farthest) {
      farthest = reached[n].length;
      far_node = static_cast<int>(n);
    }
    for (const auto& [other, edge] : edges_[n]) {
      const Reached& there = reached[static_cast<std::size_t>(other)];
      if (there.owner == own) continue;
      const Border border{reached[n].length + edge + there.length, static_cast<int>(n), other};
      const auto [at, is_new] = borders.try_emplace(there.owner, border);
      if (!is_new && border.length < at->second.length) at->second = border;
    }
  }
  std::vector<std::pair<double, int>> found;
  double widest = 0.0;
  for (const auto& [other, border] : borders) {
    const int middle = middle_of_way(reached, border.from, border.to);
    widest = std::max(widest, 0.5 * border.length);
    if (middle >= 0) found.emplace_back(border.length, middle);
  }
  if (far_node >= 0 && farthest > widest) found.emplace_back(2.0 * farthest, far_node);
  std::sort(found.begin(), found.end());
  std::vector<std::string> out;
  for (const auto& [length, node] : found)
    if (const std::string& name = names_[static_cast<std::size_t>(node)]; std::find(out.begin(), out.end(), name) == out.end())
      out.push_back(name);
  return out;
}

Place node_place(const Structure& structure, const std::string& name) {
  const fe::ParametricSystem& system = *structure.system;
  Place place{"node:" + name, Vector3d::Zero(), {}, {}, {}, {}, {}};
  std::vector<Eigen::Triplet<double>> entries;
  int columns = structure.model != nullptr ? 3 : 0;  // a node of a matrix model has the directions that it has
  for (std::size_t i = 0; i < system.dofs.size(); ++i) {
    const fe::DofLabel& dof = system.dofs[i];
    if (dof.node != name) continue;
    place.x_m = dof.x_m;
    if (dof.direction > 2) continue;
    entries.emplace_back(static_cast<int>(i), structure.model != nullptr ? dof.direction : columns++, 1.0);
  }
  place.directions.resize(system.size(), columns);
  place.directions.setFromTriplets(entries.begin(), entries.end());
  return place;
}

std::vector<Place> halves_of(const Structure& structure, const Places& places, const Place& whole) {
  if (structure.model == nullptr) return {};
  const fe::Model& model = *structure.model;
  std::vector<int> elements = elements_of(structure, whole);
  if (elements.size() < 2) return {};
  std::vector<Vector3d> middles;
  for (const int e : elements) middles.push_back(middle_of_element(model, e));
  const Vector3d along = longest_direction(middles);
  std::stable_sort(elements.begin(), elements.end(), [&](int a, int b) {
    return along.dot(middle_of_element(model, a)) < along.dot(middle_of_element(model, b));
  });
  std::set<std::string> taken;
  for (const auto& [set, list] : places.sets)
    for (const Place& place : list) taken.insert(place.id);
  const ElementPlaces parts(structure);
  const auto cut = elements.begin() + std::ssize(elements) / 2;
  std::vector<Place> out;
  for (std::vector<int> half : {std::vector<int>(elements.begin(), cut), std::vector<int>(cut, elements.end())}) {
    Place place = parts.part(half);
    std::stable_sort(half.begin(), half.end(), [&](int a, int b) {
      return (middle_of_element(model, a) - place.x_m).norm() < (middle_of_element(model, b) - place.x_m).norm();
    });
    const auto name_of_element = [&](int e) {
      return "element:" + std::to_string(model.elements[static_cast<std::size_t>(e)].id);
    };
    const auto named = std::find_if(half.begin(), half.end(), [&](int e) { return !taken.contains(name_of_element(e)); });
    if (named == half.end()) continue;
    place.id = name_of_element(*named);
    taken.insert(place.id);
    for (const char* kept : {"least_change", "most_change"})
      if (const auto number = whole.attributes.find(kept); number != whole.attributes.end()) place.attributes.insert(*number);
    out.push_back(std::move(place));
  }
  return out;
}

}  // namespace twindeck::diagnosis
