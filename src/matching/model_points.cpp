#include "matching/model_points.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace twindeck::matching {

namespace {

constexpr double same_place_m = 1e-6;  ///< far above rounding of coordinates, far below the size of a sensor
constexpr double same_motion = 1e-9;   ///< [-] of factors of a displacement: rounding of links and constraints
using Motion = std::map<int, double>;  ///< free degrees of freedom with their factors

const fe::DofMap& map_of(const ModelPoints& points) {
  if (!points.map) points.map = std::make_shared<const fe::DofMap>(fe::make_dof_map(*points.model));
  return *points.map;
}

bool can_move(const fe::DofMap& map, std::size_t node) {
  return std::any_of(map.rows.begin() + static_cast<std::ptrdiff_t>(6 * node),
                     map.rows.begin() + static_cast<std::ptrdiff_t>(6 * node + 6),
                     [](const auto& row) { return !row.empty(); });
}

bool has_dof_along(const ModelPoints& points, std::size_t node, const std::array<double, 6>& cosine) {
  for (std::size_t d = 0; d < 6; ++d)
    if (cosine[d] != 0.0 && points.row[node][d] >= 0) return true;
  return false;
}

Motion motion_along(const fe::DofMap& map, std::size_t node, const std::array<double, 6>& cosine) {
  Motion motion;
  for (std::size_t d = 0; d < 6; ++d) {
    if (cosine[d] == 0.0) continue;
    for (const fe::DofMap::Entry& entry : map.rows[6 * node + d]) motion[entry.dof] += cosine[d] * entry.factor;
  }
  std::erase_if(motion, [](const auto& part) { return std::abs(part.second) < same_motion; });
  return motion;
}

bool alike(const Motion& a, const Motion& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p.first == q.first && std::abs(p.second - q.second) < same_motion;
  });
}

}  // namespace

ModelPoints points_of(const fe::Model* model, const std::vector<fe::DofLabel>& dofs) {
  ModelPoints points;
  points.model = model;
  if (model != nullptr) {
    for (std::size_t i = 0; i < model->nodes.size(); ++i) {
      points.node.push_back(std::to_string(model->nodes[i].id));
      points.x_m.push_back(model->nodes[i].x_m);
      const auto first = static_cast<Eigen::Index>(6 * i);
      points.row.push_back({first, first + 1, first + 2, first + 3, first + 4, first + 5});
    }
    points.named = model->monitoring_points;
    return points;
  }
  std::map<std::string, std::size_t> at;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const fe::DofLabel& dof = dofs[i];
    const auto [where, is_new] = at.try_emplace(dof.node, points.node.size());
    if (is_new) {
      points.node.push_back(dof.node);
      points.x_m.push_back(dof.x_m);
      points.row.push_back({-1, -1, -1, -1, -1, -1});
    }
    points.row[where->second][static_cast<std::size_t>(dof.direction)] = static_cast<Eigen::Index>(i);
  }
  return points;
}

std::vector<std::size_t> nodes_at_the_place_of(const ModelPoints& points, std::size_t node) {
  std::vector<std::size_t> there;
  for (std::size_t i = 0; i < points.node.size(); ++i)
    if ((points.x_m[i] - points.x_m[node]).norm() <= same_place_m) there.push_back(i);
  return there;
}

std::vector<std::size_t> possible_nodes(const ModelPoints& points, const std::vector<std::size_t>& there,
                                        const std::string& name, const std::array<double, 6>& cosine) {
  const auto named = points.named.find(name);
  for (const std::size_t node : there)
    if (named != points.named.end() && static_cast<std::size_t>(named->second) == node) return {node};
  for (const std::size_t node : there)
    if (points.node[node] == name) return {node};
  std::vector<std::size_t> left;
  if (points.model != nullptr) {
    const fe::DofMap& map = map_of(points);
    std::copy_if(there.begin(), there.end(), std::back_inserter(left), [&](std::size_t node) { return can_move(map, node); });
  } else {
    std::copy_if(there.begin(), there.end(), std::back_inserter(left),
                 [&](std::size_t node) { return has_dof_along(points, node, cosine); });
  }
  return left.empty() ? there : left;
}

bool move_as_one(const ModelPoints& points, const std::vector<std::size_t>& nodes, const std::array<double, 6>& cosine) {
  if (nodes.size() < 2) return true;
  if (points.model == nullptr)  // each degree of freedom is one of its own; without a direction any of them may be meant
    return cosine != std::array<double, 6>{} &&
           std::none_of(nodes.begin(), nodes.end(), [&](std::size_t node) { return has_dof_along(points, node, cosine); });
  const fe::DofMap& map = map_of(points);
  const Motion first = motion_along(map, nodes.front(), cosine);
  return std::all_of(nodes.begin() + 1, nodes.end(),
                     [&](std::size_t node) { return alike(first, motion_along(map, node, cosine)); });
}

}  // namespace twindeck::matching
