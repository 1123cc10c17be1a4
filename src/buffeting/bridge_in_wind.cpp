#include "buffeting/bridge_in_wind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <cmath>

#include "buffeting/loads.hpp"
#include "core/error.hpp"

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Loads of a unit gust on each strip, v' and w', by rule A, over the free degrees of freedom. @return (n × 2 n_strips)
MatrixXd gust_patterns(const BridgeInWind& bridge, const WindEventSettings& config) {
  const double intensity_ratio = 0.5;  // w' is about half as strong as v': patterns are weighed by their size
  MatrixXd patterns = nodal_patterns(bridge, aero::everywhere(aero::published_yaw_rule("A")), 1.0, config.equations,
                                     {wind::Component::along, wind::Component::vertical});
  patterns.rightCols(std::ssize(bridge.model.strips)) *= intensity_ratio;
  return patterns;
}

/// Unit vertical forces at the monitoring points, over the free degrees of freedom. @return (n × n_points)
MatrixXd point_patterns(const dynamics::LoadedModel& loaded) {
  const std::vector<std::string> names = buffeting::accelerometers(*loaded.model);
  MatrixXd nodal = MatrixXd::Zero(loaded.system.expansion.rows(), std::ssize(names));
  for (std::size_t p = 0; p < names.size(); ++p)
    nodal(6 * loaded.model->monitoring_points.at(names[p]) + 2, static_cast<Index>(p)) = 1.0;
  return loaded.system.expansion.transpose() * nodal;
}

Sensors find_sensors(const dynamics::LoadedModel& loaded, const aero::WindModel& model, const MatrixXd& vectors) {
  Sensors out;
  const MatrixXd full = loaded.system.expand(vectors);
  const std::vector<aero::StripMotion> motions = aero::motions_of(model.nodes, full);
  out.points = buffeting::accelerometers(*loaded.model);
  for (std::size_t i = 1; i < motions.size(); i += 3) out.nodes.push_back(i);
  out.motion.resize(out.lateral_row(out.nodes.size()), vectors.cols());
  for (std::size_t p = 0; p < out.points.size(); ++p)
    out.motion.middleRows<3>(3 * static_cast<Index>(p)) =
        full.middleRows<3>(6 * loaded.model->monitoring_points.at(out.points[p]));
  for (std::size_t i = 0; i < out.nodes.size(); ++i) {
    out.motion.row(out.lateral_row(i)) = model.strips[out.nodes[i]].normal.transpose() * motions[out.nodes[i]].topRows<3>();
    out.motion.row(out.vertical_row(i)) = motions[out.nodes[i]].row(2);
  }
  return out;
}

}  // namespace

std::vector<std::string> accelerometers(const fe::Model& model) {
  std::vector<std::string> names;
  for (const auto& [name, node] : model.monitoring_points)
    if (name.starts_with("M")) names.push_back(name);
  return names;
}

BridgeInWind prepare_bridge_in_wind(const WindEventSettings& config, const aero::WindSettings& aerodynamics,
                                    const dynamics::ReadModel& model, const std::vector<aero::SectionAero>& sections) {
  BridgeInWind out;
  out.aerodynamics = aerodynamics;
  out.loaded = dynamics::solvable(model);
  out.model = aero::prepare_wind_model(out.aerodynamics, out.loaded);
  out.sections = sections;
  aero::Reduction reduction;
  reduction.dampers = config.dampers;
  reduction.static_shapes = config.static_shapes;
  reduction.patterns = gust_patterns(out, config);
  reduction.points = point_patterns(out.loaded);
  reduction.point_generations = config.point_shapes;
  out.reduced = reduce(out.model, out.loaded, out.aerodynamics.structural_damping, reduction);
  out.sensors = find_sensors(out.loaded, out.model, out.reduced.vectors);
  out.frozen_omega = std::sqrt(out.model.modes.eigenvalue[0]);
  return out;
}

aero::Deployment deployment_of(const aero::WindSettings& config, const std::string& model) {
  std::vector<std::string> known;
  for (aero::Deployment& deployment : config.deployments()) {
    if (deployment.name == model) return deployment;
    known.push_back(deployment.name);
  }
  throw InputError({"", 0, "run"}, "names the model '" + model + "'" + did_you_mean(model, known),
                   fmt::format("step 7 has {}", fmt::join(known, ", ")));
}

aero::AeroelasticSystem system_of(const BridgeInWind& bridge, const aero::Deployment& deployment) {
  return {bridge.reduced.structure,   bridge.sections, bridge.model.strips, bridge.reduced.motions,
          bridge.aerodynamics.wind(), deployment};
}

MatrixXd nodal_patterns(const BridgeInWind& bridge, const aero::Deployment& deployment, double speed_m_s,
                        aero::Equations equations, const std::vector<wind::Component>& components) {
  const Index n = std::ssize(bridge.model.strips), kinds = std::ssize(components);
  MatrixXd at_nodes = MatrixXd::Zero(6 * n, kinds * n);
  for (Index i = 0; i < n; ++i) {
    const aero::Strip& strip = bridge.model.strips[static_cast<std::size_t>(i)];
    const MatrixXd load =
        strip_load(bridge.sections[static_cast<std::size_t>(strip.section)], strip, deployment.at(strip.deck, strip.yaw_rad),
                   bridge.aerodynamics.wind(), speed_m_s, equations, components);
    for (Index k = 0; k < kinds; ++k) at_nodes.block<6, 1>(6 * i, k * n + i) = load.col(k);
  }
  const MatrixXd nodal = bridge.model.nodes.motion.transpose() * at_nodes;
  return bridge.loaded.system.expansion.transpose() * nodal;
}

wind::FieldDefinition field_at_nodes(const BridgeInWind& bridge, const wind::TurbulenceSet& set, double height_m,
                                     double speed_m_s, wind::Component component, bool frozen) {
  const Eigen::Vector3d along = bridge.aerodynamics.wind().direction, across = Eigen::Vector3d::UnitZ().cross(along);
  const auto n = std::ssize(bridge.model.strips);
  wind::FieldDefinition field;
  field.component = component;
  field.position_m.resize(n, 3);
  for (Index i = 0; i < n; ++i) {
    const Eigen::Vector3d& x = bridge.model.strips[static_cast<std::size_t>(i)].x_m;
    field.position_m.row(i) << x.dot(along), x.dot(across), x.z();
  }
  field.speed_m_s = Eigen::VectorXd::Constant(n, speed_m_s);
  field.sigma_m_s = Eigen::VectorXd::Constant(n, wind::standard_deviation(set, component, height_m, speed_m_s));
  field.length_m = Eigen::VectorXd::Constant(n, wind::length_scale(set, component, height_m));
  const auto c = static_cast<std::size_t>(component);
  field.decay = set.decay[c];
  field.law = set.spectrum[c];
  field.coherence_table = set.coherence[c];
  field.frozen = frozen;
  return field;
}

std::vector<wind::FieldDefinition> fields_at_nodes(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                                   const WindEventSettings& config, double speed_m_s) {
  std::vector<wind::FieldDefinition> fields;
  for (const wind::Component component : config.components())
    fields.push_back(field_at_nodes(bridge, set, config.height_m, speed_m_s, component, config.frozen));
  return fields;
}

}  // namespace twindeck::buffeting
