#include <algorithm>
#include <map>
#include <set>

#include "diagnosis/reduction/place_parts.hpp"

/// Other positions of a support on a line of beams.
namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kStraight = 0.8;       // least cosine of the angle between two beams of one line
constexpr std::size_t kMostNodes = 24;  // to either side of the support

/// Nodes of a line of beams on one side of a node, with the distance to each along the line.
std::vector<std::pair<int, double>> walk(const fe::Model& model, const std::multimap<int, int>& beams, int from,
                                         Vector3d towards) {
  std::vector<std::pair<int, double>> out;
  std::set<int> passed = {from};
  double way = 0.0;
  for (int at = from; out.size() < kMostNodes;) {
    int next = -1;
    double best = kStraight;
    const auto [first, last] = beams.equal_range(at);
    for (auto neighbour = first; neighbour != last; ++neighbour) {
      const Vector3d step =
          model.nodes[static_cast<std::size_t>(neighbour->second)].x_m - model.nodes[static_cast<std::size_t>(at)].x_m;
      const double along = step.norm() > 0.0 ? step.normalized().dot(towards) : 0.0;
      if (passed.contains(neighbour->second) || along <= best) continue;
      best = along;
      next = neighbour->second;
    }
    if (next < 0) break;
    const Vector3d step = model.nodes[static_cast<std::size_t>(next)].x_m - model.nodes[static_cast<std::size_t>(at)].x_m;
    way += step.norm();
    towards = step.normalized();
    out.emplace_back(next, way);
    passed.insert(next);
    at = next;
  }
  return out;
}

std::multimap<int, int> beams_of(const fe::Model& model) {
  std::multimap<int, int> beams;
  for (const fe::Element& element : model.elements) {
    if (element.type != fe::ElementType::beam) continue;
    beams.emplace(element.nodes[0], element.nodes[1]);
    beams.emplace(element.nodes[1], element.nodes[0]);
  }
  return beams;
}

/// Nodes of the line through a support in order, each with its distance from the support, negative on the side of smaller x
/// (y, z where the line goes across x).
std::vector<std::pair<int, double>> line_through(const fe::Model& model, const std::multimap<int, int>& beams, int node) {
  const auto [first, last] = beams.equal_range(node);
  if (first == last) return {};
  Vector3d along = model.nodes[static_cast<std::size_t>(first->second)].x_m - model.nodes[static_cast<std::size_t>(node)].x_m;
  if (!(along.norm() > 0.0)) return {};
  along.normalize();
  Index axis = 0;
  along.cwiseAbs().maxCoeff(&axis);
  if (along[axis] < 0.0) along = -along;
  std::vector<std::pair<int, double>> line;
  for (const auto& [other, way] : walk(model, beams, node, -along)) line.emplace_back(other, -way);
  std::reverse(line.begin(), line.end());
  line.emplace_back(node, 0.0);
  for (const auto& step : walk(model, beams, node, along)) line.push_back(step);
  return line;
}

}  // namespace

void ElementPlaces::add_support_moves(Places& places) const {
  const std::multimap<int, int> beams = beams_of(model_);
  for (const Place& support : places.sets["supports"]) {
    std::vector<const fe::Spring*> springs;  // of this support: translations to the ground, all at one node
    const std::string name = support.id.substr(support.id.find(':') + 1);
    bool clamped = false;  // a foot with rotational stiffness is built in and cannot move
    for (const fe::Spring& spring : model_.springs) {
      if ((spring.group.empty() ? spring.name : spring.group) != name || spring.node2 >= 0 || !fe::carries_stiffness(spring))
        continue;
      clamped = clamped || spring.rotation;
      if (!spring.rotation && spring.damping == 0.0 && spring.friction_N == 0.0) springs.push_back(&spring);
    }
    // If the support also has bearings, its rigid springs are a location of their own, which does not move.
    const auto rigid = [&](const fe::Spring* s) { return stands_for_rigid(*s); };
    if (!std::ranges::all_of(springs, rigid)) std::erase_if(springs, rigid);
    if (springs.empty() || clamped) continue;
    const int node = springs.front()->node;
    if (std::ranges::any_of(springs, [&](const fe::Spring* s) { return s->node != node; })) continue;
    const std::vector<std::pair<int, double>> line = line_through(model_, beams, node);
    constexpr std::size_t kFewest = 4;  // nodes that a support can move between
    if (line.size() < kFewest) continue;
    Place place{.id = support.id, .x_m = support.x_m, .stiffness = support.stiffness, .stiffness_law = support.stiffness_law};
    std::vector<Eigen::Triplet<double>> entries;
    const auto per_node = static_cast<Index>(springs.size());
    const Vector3d x = model_.nodes[static_cast<std::size_t>(node)].x_m;
    const Vector3d chord = model_.nodes[static_cast<std::size_t>(line.back().first)].x_m -
                           model_.nodes[static_cast<std::size_t>(line.front().first)].x_m;
    Index axis = 0;
    chord.cwiseAbs().maxCoeff(&axis);
    const auto set = [&](const std::string& key, double value) { place.attributes[key] = value; };
    for (std::size_t i = 0; i < line.size(); ++i) {
      set("x_" + std::to_string(i), x[axis] + line[i].second);
      set("node_" + std::to_string(i), line[i].first);
      for (Index d = 0; d < per_node; ++d)
        for (int k = 0; k < 3; ++k)
          if (const double part = springs[static_cast<std::size_t>(d)]->direction[k]; part != 0.0)
            entries.emplace_back(6 * line[i].first + k, static_cast<int>(i) * static_cast<int>(per_node) + static_cast<int>(d),
                                 part);
    }
    for (Index d = 0; d < per_node; ++d) set("k_" + std::to_string(d), springs[static_cast<std::size_t>(d)]->stiffness);
    set("stations", static_cast<double>(line.size()));
    set("x_low", place.attributes.at("x_0"));
    set("x_high", place.attributes.at("x_" + std::to_string(line.size() - 1)));
    constexpr int kStarts = 8;  // trial positions of the screen, evenly between the ends
    for (int s = 0; s < kStarts; ++s)
      set("x_start_" + std::to_string(s),
          place.attributes["x_low"] + (s + 0.5) / kStarts * (place.attributes["x_high"] - place.attributes["x_low"]));
    place.directions = free_directions(entries, std::ssize(line) * per_node);
    places.sets["support_moves"].push_back(std::move(place));
  }
}

}  // namespace twindeck::diagnosis
