#include "matching/shapes_at_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::matching {

namespace {

using Eigen::Index;

const std::array<std::string, 6> kDirections = {"x", "y", "z", "rx", "ry", "rz"};

/// Advice for a sensor that lies on no node: another unit, if that brings it to a node.
std::string mend_of_position(const ModelPoints& points, const Eigen::Vector3d& x_m, double tolerance_m) {
  const auto meets_a_node = [&](double factor) {
    return std::ranges::any_of(points.x_m, [&](const Eigen::Vector3d& node) {
      return (node - factor * x_m).norm() <= tolerance_m * std::max(1.0, factor);
    });
  };
  // In a smaller unit any position would lie within the tolerance of a node at the origin.
  if (1e-3 * x_m.norm() > tolerance_m && meets_a_node(1e-3))
    return "in mm it would lie on a node: give x_m, y_m, z_m of channels.csv in m";
  if (x_m.norm() > tolerance_m && meets_a_node(1e3)) return "the model seems to be in mm: give x_m, y_m, z_m of nodes.csv in m";
  return "check x_m, y_m, z_m in channels.csv and the axes of the model, or raise `sensor_tolerance`";
}

using Cosines = std::array<double, 6>;  ///< along x … rz

/// The cosines that a channel's row or the dof's name state; zeros if neither does.
Cosines stated_cosines(const modal::ShapeDof& dof, const Channel* channel) {
  Cosines cosine{};
  const auto named = std::ranges::find(kDirections, dof.direction);
  if (channel != nullptr && channel->direction.squaredNorm() > 0.0) {
    for (std::size_t d = 0; d < 3; ++d) cosine[d] = channel->direction[static_cast<Index>(d)];
  } else if (named != kDirections.end()) {
    cosine[static_cast<std::size_t>(named - kDirections.begin())] = 1.0;
  }
  return cosine;
}

/// What happens if nodes coincide and the sensor may stand on any of them.
enum class Doubt { refused, first };

std::size_t one_of(const ModelPoints& points, std::size_t nearest, const modal::ShapeDof& dof, const Channel& channel,
                   const Measured& measured, Doubt doubt) {
  const std::vector<std::size_t> there = nodes_at_the_place_of(points, nearest);
  if (there.size() < 2) return nearest;
  const Cosines cosine = stated_cosines(dof, &channel);
  const std::vector<std::size_t> possible = possible_nodes(points, there, dof.point, cosine);
  if (doubt == Doubt::refused && !move_as_one(points, possible, cosine)) {
    const auto names = each_of(possible, [&](std::size_t node) { return points.node[node]; });
    throw InputError({measured.source, 0, channel.name},
                     fmt::format("lies where the nodes {} coincide, which can move apart", fmt::join(names, ", ")),
                     fmt::format("say on which of them it stands: name '{}' in points.csv of the model, or give the node's id "
                                 "as the point in channels.csv",
                                 dof.point));
  }
  return possible.front();
}

std::size_t node_of(const ModelPoints& points, const modal::ShapeDof& dof, const Channel* channel, const Measured& measured,
                    double tolerance_m, Doubt doubt) {
  // The position decides before the name: a sensor point called "12" need not be node 12. Among nodes at one position the name
  // decides.
  if (channel != nullptr && channel->x_m) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.node.size(); ++i) {
      const double distance = (points.x_m[i] - *channel->x_m).norm();
      if (distance < least) {
        least = distance;
        nearest = i;
      }
    }
    if (least <= tolerance_m) return one_of(points, nearest, dof, *channel, measured, doubt);
    if (std::isfinite(least))
      throw InputError({measured.source, 0, channel->name},
                       fmt::format("lies {:.2f} m from the nearest node ({}), expected at most {:.2f} m", least,
                                   points.node[nearest], tolerance_m),
                       mend_of_position(points, *channel->x_m, tolerance_m));
  }
  const auto by_name = std::ranges::find(points.node, dof.point);
  if (by_name != points.node.end()) return static_cast<std::size_t>(by_name - points.node.begin());
  throw InputError({measured.source, 0, dof.point},
                   fmt::format("is no node of the model, and channel '{}' has no usable position{}", dof.direction,
                               did_you_mean(dof.point, points.node)),
                   "give the node's id as the point, or the channel's x_m, y_m, z_m in channels.csv");
}

/// A part of what a channel shows: `cosine` times a row of the expanded shapes.
struct ChannelPart {
  Index row = 0;
  double cosine = 0.0;
};

std::vector<std::vector<ChannelPart>> placed(const Measured& measured, const ModelPoints& points, double tolerance_m,
                                             Doubt doubt = Doubt::first) {
  std::vector<std::vector<ChannelPart>> out(measured.modes.dofs.size());
  for (std::size_t i = 0; i < measured.modes.dofs.size(); ++i) {
    const modal::ShapeDof& dof = measured.modes.dofs[i];
    const auto found = std::ranges::find(measured.channels, dof.direction, &Channel::name);
    const Channel* channel = found == measured.channels.end() ? nullptr : &*found;
    const std::size_t node = node_of(points, dof, channel, measured, tolerance_m, doubt);
    Cosines cosine = stated_cosines(dof, channel);
    const bool stated = cosine != Cosines{};
    if (!stated && std::ranges::count_if(points.row[node], [](Index row) { return row >= 0; }) == 1) {
      // The node has one degree of freedom, so the channel must measure it.
      for (std::size_t d = 0; d < 6; ++d) cosine[d] = points.row[node][d] >= 0 ? 1.0 : 0.0;
    } else if (!stated) {
      throw InputError({measured.source, 0, dof.direction},
                       "is no direction (x, y, z, rx, ry, rz) and no channel with direction cosines",
                       "give dx, dy, dz of the channel in channels.csv");
    }
    for (std::size_t d = 0; d < 6; ++d) {
      // Fixed in this direction, or condensed away: an FE node has a row of zeros, a matrix model no row at all.
      if (cosine[d] != 0.0 && points.row[node][d] >= 0) out[i].push_back({points.row[node][d], cosine[d]});
    }
  }
  return out;
}

ModelPoints points_in(const dynamics::LoadedModel& model) { return points_of(model.fe_model(), model.system.dofs); }

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

void refuse_unplaced_channels(const Measured& measured, const dynamics::ReadModel& model, double tolerance_m) {
  static_cast<void>(placed(measured, points_of(model.fe_model(), model.matrices.dofs), tolerance_m, Doubt::refused));
}

Eigen::MatrixXcd shapes_at_sensors(const Measured& measured, const dynamics::LoadedModel& model,
                                   const dynamics::EigenModes& modes, double tolerance_m) {
  const std::vector<std::vector<ChannelPart>> parts = placed(measured, points_in(model), tolerance_m);
  const Eigen::MatrixXd values = model.system.expand(modes.shapes);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(parts), modes.shapes.cols());
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const ChannelPart& part : parts[i]) out.row(static_cast<Index>(i)) += part.cosine * values.row(part.row);
  return out.cast<std::complex<double>>();
}

Eigen::MatrixXd sensor_vectors(const Measured& measured, const dynamics::LoadedModel& model, double tolerance_m) {
  const std::vector<std::vector<ChannelPart>> parts = placed(measured, points_in(model), tolerance_m);
  Eigen::MatrixXd chosen =
      Eigen::MatrixXd::Zero(model.model ? model.system.expansion.rows() : model.system.size(), std::ssize(parts));
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const ChannelPart& part : parts[i]) chosen(part.row, static_cast<Index>(i)) += part.cosine;
  if (!model.model) return chosen;
  return model.system.expansion.transpose() * chosen;
}

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
  std::ranges::copy_if(there, std::back_inserter(left), [&](std::size_t node) {
    return points.model != nullptr ? can_move(map_of(points), node) : has_dof_along(points, node, cosine);
  });
  return left.empty() ? there : left;
}

bool move_as_one(const ModelPoints& points, const std::vector<std::size_t>& nodes, const std::array<double, 6>& cosine) {
  if (nodes.size() < 2) return true;
  if (points.model == nullptr)  // each degree of freedom is one of its own; without a direction any of them may be meant
    return cosine != std::array<double, 6>{} &&
           std::ranges::none_of(nodes, [&](std::size_t node) { return has_dof_along(points, node, cosine); });
  const fe::DofMap& map = map_of(points);
  const Motion first = motion_along(map, nodes.front(), cosine);
  return std::all_of(nodes.begin() + 1, nodes.end(),
                     [&](std::size_t node) { return alike(first, motion_along(map, node, cosine)); });
}

}  // namespace twindeck::matching
