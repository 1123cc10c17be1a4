#include "matching/shapes_at_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.hpp"

namespace twindeck::matching {

namespace {

using Eigen::Index;

const std::array<std::string, 6> kDirections = {"x", "y", "z", "rx", "ry", "rz"};

/// Where the modes of a model are known: six values a node (FE), or single dofs (matrix model).
struct ModelPoints {
  std::vector<std::string> node;          ///< name of each node
  std::vector<Eigen::Vector3d> x_m;       ///< NaN where unknown
  std::vector<std::array<Index, 6>> row;  ///< rows of the expanded shapes; -1 where the node lacks the direction
};

/// @param model  null for a matrix model, whose points are those of its `dofs`
ModelPoints points_of(const fe::Model* model, const std::vector<fe::DofLabel>& dofs) {
  ModelPoints points;
  if (model != nullptr) {
    for (std::size_t i = 0; i < model->nodes.size(); ++i) {
      points.node.push_back(std::to_string(model->nodes[i].id));
      points.x_m.push_back(model->nodes[i].x_m);
      const auto first = static_cast<Index>(6 * i);
      points.row.push_back({first, first + 1, first + 2, first + 3, first + 4, first + 5});
    }
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
    points.row[where->second][static_cast<std::size_t>(dof.direction)] = static_cast<Index>(i);
  }
  return points;
}

/// What to do about a sensor that lies on no node: another unit, where that brings it to one.
std::string mend_of_position(const ModelPoints& points, const Eigen::Vector3d& x_m, double tolerance_m) {
  const auto meets_a_node = [&](double factor) {
    return std::any_of(points.x_m.begin(), points.x_m.end(), [&](const Eigen::Vector3d& node) {
      return (node - factor * x_m).norm() <= tolerance_m * std::max(1.0, factor);
    });
  };
  // A node at the origin would meet any position that is small enough.
  if (1e-3 * x_m.norm() > tolerance_m && meets_a_node(1e-3))
    return "in mm it would lie on a node: give x_m, y_m, z_m of channels.csv in m";
  if (x_m.norm() > tolerance_m && meets_a_node(1e3)) return "the model seems to be in mm: give x_m, y_m, z_m of nodes.csv in m";
  return "check x_m, y_m, z_m in channels.csv and the axes of the model, or raise `sensor_tolerance`";
}

std::size_t node_of(const ModelPoints& points, const modal::ShapeDof& dof, const Channel* channel, const Measured& measured,
                    double tolerance_m) {
  // Positions go before names: a sensor point called "12" need not be node 12.
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
    if (least <= tolerance_m) return nearest;
    if (std::isfinite(least)) {
      throw InputError({measured.source, 0, channel->name},
                       fmt::format("lies {:.2f} m from the nearest node ({}), expected at most {:.2f} m", least,
                                   points.node[nearest], tolerance_m),
                       mend_of_position(points, *channel->x_m, tolerance_m));
    }
  }
  const auto by_name = std::find(points.node.begin(), points.node.end(), dof.point);
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

/// The parts of each measured degree of freedom.
std::vector<std::vector<ChannelPart>> placed(const Measured& measured, const ModelPoints& points, double tolerance_m) {
  std::vector<std::vector<ChannelPart>> out(measured.modes.dofs.size());
  for (std::size_t i = 0; i < measured.modes.dofs.size(); ++i) {
    const modal::ShapeDof& dof = measured.modes.dofs[i];
    const auto found = std::find_if(measured.channels.begin(), measured.channels.end(),
                                    [&](const Channel& c) { return c.name == dof.direction; });
    const Channel* channel = found == measured.channels.end() ? nullptr : &*found;
    const std::size_t node = node_of(points, dof, channel, measured, tolerance_m);
    std::array<double, 6> cosine{};
    const auto named = std::find(kDirections.begin(), kDirections.end(), dof.direction);
    if (channel != nullptr && channel->direction.squaredNorm() > 0.0) {
      for (std::size_t d = 0; d < 3; ++d) cosine[d] = channel->direction[static_cast<Index>(d)];
    } else if (named != kDirections.end()) {
      cosine[static_cast<std::size_t>(named - kDirections.begin())] = 1.0;
    } else if (std::count_if(points.row[node].begin(), points.row[node].end(), [](Index row) { return row >= 0; }) == 1) {
      // A node that carries one dof: the channel can mean nothing else.
      for (std::size_t d = 0; d < 6; ++d) cosine[d] = points.row[node][d] >= 0 ? 1.0 : 0.0;
    } else {
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

ModelPoints points_of(const dynamics::LoadedModel& model) { return points_of(model.fe_model(), model.system.dofs); }

}  // namespace

void refuse_unplaced_channels(const Measured& measured, const dynamics::ReadModel& model, double tolerance_m) {
  static_cast<void>(placed(measured, points_of(model.fe_model(), model.matrices.dofs), tolerance_m));
}

Eigen::MatrixXcd shapes_at_sensors(const Measured& measured, const dynamics::LoadedModel& model,
                                   const dynamics::EigenModes& modes, double tolerance_m) {
  const std::vector<std::vector<ChannelPart>> parts = placed(measured, points_of(model), tolerance_m);
  const Eigen::MatrixXd values = model.system.expand(modes.shapes);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(parts), modes.shapes.cols());
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const ChannelPart& part : parts[i]) out.row(static_cast<Index>(i)) += part.cosine * values.row(part.row);
  return out.cast<std::complex<double>>();
}

Eigen::MatrixXd sensor_vectors(const Measured& measured, const dynamics::LoadedModel& model, double tolerance_m) {
  const std::vector<std::vector<ChannelPart>> parts = placed(measured, points_of(model), tolerance_m);
  Eigen::MatrixXd chosen =
      Eigen::MatrixXd::Zero(model.model ? model.system.expansion.rows() : model.system.size(), std::ssize(parts));
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const ChannelPart& part : parts[i]) chosen(part.row, static_cast<Index>(i)) += part.cosine;
  if (!model.model) return chosen;
  return model.system.expansion.transpose() * chosen;
}

}  // namespace twindeck::matching
