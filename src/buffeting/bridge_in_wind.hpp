#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "aero/wind_model.hpp"
#include "aero/wind_settings.hpp"
#include "buffeting/wind_event_settings.hpp"
#include "dynamics/loaded_model.hpp"
#include "wind/simulation.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::buffeting {

/// Where accelerations are wanted: monitoring points in x, y, z, then every third aerodynamic node lateral (along the
/// deck's normal) and vertical.
struct Sensors {
  std::vector<std::string> points;  ///< names of the monitoring points
  std::vector<std::size_t> nodes;   ///< positions of these aerodynamic nodes
  Eigen::MatrixXd motion;           ///< (3 n_points + 2 n_nodes × m) of each coordinate
  [[nodiscard]] Eigen::Index vertical(std::size_t point) const { return 3 * static_cast<Eigen::Index>(point) + 2; }
  [[nodiscard]] Eigen::Index lateral_row(std::size_t node) const {
    return 3 * std::ssize(points) + 2 * static_cast<Eigen::Index>(node);
  }
  [[nodiscard]] Eigen::Index vertical_row(std::size_t node) const { return lateral_row(node) + 1; }
};

/// Names of the monitoring points, which begin with M; other named points are no accelerometers.
[[nodiscard]] std::vector<std::string> accelerometers(const fe::Model& model);

/// The updated bridge prepared for turbulent wind.
struct BridgeInWind {
  dynamics::LoadedModel loaded;
  aero::WindSettings aerodynamics;
  std::vector<aero::SectionAero> sections;
  aero::WindModel model;
  aero::DampedModel reduced;  ///< with dampers or without, modes and static shapes
  Sensors sensors;
  double frozen_omega = 0.0;  ///< of mode 1: at which derivatives are taken in time
};
/// @param aerodynamics  decks, direction, damping  @param sections  of the aerodynamic set, at its level
[[nodiscard]] BridgeInWind prepare_bridge_in_wind(const WindEventSettings& config, const aero::WindSettings& aerodynamics,
                                                  const dynamics::ReadModel& model,
                                                  const std::vector<aero::SectionAero>& sections);

/// The deployment that a run names. @throws InputError for an unknown model
[[nodiscard]] aero::Deployment deployment_of(const aero::WindSettings& config, const std::string& model);
[[nodiscard]] aero::AeroelasticSystem system_of(const BridgeInWind& bridge, const aero::Deployment& deployment);

/// The wind's force on the strips per unit of each component, over the free degrees of freedom.
/// @return (n × n_components n_strips)
[[nodiscard]] Eigen::MatrixXd nodal_patterns(const BridgeInWind& bridge, const aero::Deployment& deployment, double speed_m_s,
                                             aero::Equations equations, const std::vector<wind::Component>& components);

/// One component at the aerodynamic nodes in a mean wind.
[[nodiscard]] wind::FieldDefinition field_at_nodes(const BridgeInWind& bridge, const wind::TurbulenceSet& set, double height_m,
                                                   double speed_m_s, wind::Component component, bool frozen);
/// The components that load the decks, in the order of the load's columns.
[[nodiscard]] std::vector<wind::FieldDefinition> fields_at_nodes(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                                                 const WindEventSettings& config, double speed_m_s);

}  // namespace twindeck::buffeting
