#include "diagnosis/reduction/diagnosed_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "matching/shapes_at_sensors.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
constexpr double kRigid = 1e4;  // stiffness of a spring that replaces a rigid support, over that of the structure at its node

/// Translational and rotational stiffness of the beams and shells at a node.
std::pair<double, double> stiffness_at(const fe::Model& model, int node) {
  double translation = 0.0, rotation = 0.0;
  for (const fe::Element& element : model.elements) {
    if (!contains(element.nodes, node)) continue;
    if (element.type != fe::ElementType::beam && element.type != fe::ElementType::shell) continue;
    const double e = model.materials[static_cast<std::size_t>(element.material)].youngs_modulus_Pa;
    const fe::Section& s = model.sections[static_cast<std::size_t>(element.section)];
    if (element.type == fe::ElementType::shell) {
      translation += e * s.thickness_m;
      rotation += e * std::pow(s.thickness_m, 3) / 3.0;
      continue;
    }
    const double length = (model.nodes[static_cast<std::size_t>(element.nodes[1])].x_m -
                           model.nodes[static_cast<std::size_t>(element.nodes[0])].x_m)
                              .norm();
    const double inertia = std::max({s.inertia_y_m4, s.inertia_z_m4, s.torsion_m4});
    translation += e * s.area_m2 / length;
    rotation += 4.0 * e * inertia / length;
  }
  return {translation, rotation};
}

void release_supports(fe::Model& model, std::vector<std::string>& rigid) {
  static const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
  std::map<std::string, int> nodes_of;  // one name may hold several nodes; springs have names of their own
  for (const fe::Support& support : model.supports) ++nodes_of[support.name];
  for (fe::Support& support : model.supports) {
    const auto [translation, rotation] = stiffness_at(model, support.node);
    for (std::size_t d = 0; d < 6; ++d) {
      const double stiffness = kRigid * (d < 3 ? translation : rotation);
      if (!support.fixed[d] || !(stiffness > 0.0)) continue;
      const std::string node = std::to_string(model.nodes[static_cast<std::size_t>(support.node)].id);
      const std::string group = support.name.empty() ? "node_" + node : support.name;
      const bool shared = !support.name.empty() && nodes_of.at(support.name) > 1;
      fe::Spring spring;
      spring.name = group + (shared ? "_" + node : "") + kRigidSpring + names[d];
      spring.group = group;
      spring.node = support.node;
      spring.direction = Eigen::Vector3d::Unit(static_cast<Index>(d % 3));
      spring.rotation = d >= 3;
      spring.stiffness = stiffness;
      model.springs.push_back(spring);
      support.fixed[d] = false;
      if (!contains(rigid, group)) rigid.push_back(group);
    }
  }
  std::erase_if(model.supports, [](const fe::Support& s) { return std::ranges::none_of(s.fixed, [](bool f) { return f; }); });
}

std::vector<std::string> nodes_of_channels(const DiagnosedModel& model) {
  std::vector<std::string> names, known;
  std::vector<Eigen::Vector3d> where;
  if (model.loaded.model) {
    for (const fe::Node& node : model.loaded.model->nodes) {
      known.push_back(std::to_string(node.id));
      where.push_back(node.x_m);
    }
  } else {
    for (const fe::DofLabel& dof : model.loaded.system.dofs) {
      known.push_back(dof.node);
      where.push_back(dof.x_m);
    }
  }
  for (const matching::Channel& channel : model.channels) {
    std::string name;
    double least = model.sensor_tolerance_m;
    if (channel.is_at_a_point() && channel.x_m) {
      for (std::size_t i = 0; i < known.size(); ++i) {
        const double distance = (where[i] - *channel.x_m).norm();
        if (distance <= least) {
          least = distance;
          name = known[i];
        }
      }
    }
    if (channel.is_at_a_point() && name.empty() && contains(known, channel.point)) name = channel.point;
    names.push_back(name);
  }
  return names;
}

}  // namespace

matching::Measured channels_at_points(const std::vector<matching::Channel>& channels) {
  matching::Measured points;
  points.source = "channels.csv";
  for (const matching::Channel& channel : channels) {
    if (!channel.is_at_a_point()) continue;  // strain and force gauges measure no displacement
    points.channels.push_back(channel);
    points.modes.dofs.push_back({channel.point.empty() ? channel.name : channel.point, channel.name});
  }
  return points;
}

std::shared_ptr<DiagnosedModel> prepare_model(const dynamics::LoadedModel& loaded,
                                              const std::vector<matching::Channel>& channels, double sensor_tolerance_m) {
  auto prepared = std::make_shared<DiagnosedModel>();
  prepared->channels = channels;
  prepared->sensor_tolerance_m = sensor_tolerance_m;
  if (!loaded.model) {
    prepared->loaded = loaded;
    return prepared;
  }
  fe::Model model = *loaded.model;
  release_supports(model, prepared->rigid_supports);
  prepared->loaded = dynamics::from_model(std::move(model));
  return prepared;
}

Structure DiagnosedModel::structure() const {
  Structure out;
  out.system = &loaded.system;
  out.model = loaded.fe_model();
  out.state = loaded.model ? &loaded.state : nullptr;
  out.theta = loaded.theta;
  out.source = loaded.source;
  out.rigid_supports = rigid_supports;
  out.sensor_nodes = nodes_of_channels(*this);
  out.sensors = [this](const Eigen::MatrixXd& vectors) {
    const auto n = static_cast<Index>(channels.size());
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(4 * n, vectors.cols());
    std::vector<Index> at_points;
    for (Index c = 0; c < n; ++c)
      if (channels[static_cast<std::size_t>(c)].is_at_a_point()) at_points.push_back(c);
    if (at_points.empty()) return values;
    matching::Measured asked = channels_at_points(channels);
    for (int kind = 0; kind < 4; ++kind) {  // the channel's direction, then x, y, z at its node
      for (matching::Channel& channel : asked.channels)
        if (kind > 0) channel.direction = Eigen::Vector3d::Unit(kind - 1);
      dynamics::EigenModes modes;
      modes.shapes = vectors;
      const Eigen::MatrixXd rows = shapes_at_sensors(asked, loaded, modes, sensor_tolerance_m).real();
      for (std::size_t p = 0; p < at_points.size(); ++p) values.row(4 * at_points[p] + kind) = rows.row(static_cast<Index>(p));
    }
    return values;
  };
  return out;
}

}  // namespace twindeck::diagnosis
