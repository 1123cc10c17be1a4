#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "steps/aerodynamics/aerodynamics.hpp"
#include "steps/validation/config.hpp"
#include "steps/validation/measured.hpp"
#include "wind/simulation.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::steps {

/// Where accelerations are wanted: monitoring points in x, y, z, then every third aerodynamic node lateral (along the
/// deck's normal) and vertical.
struct Sensors {
  std::vector<std::string> points;  ///< names of the monitoring points
  std::vector<std::size_t> nodes;   ///< positions of these aerodynamic nodes
  Eigen::MatrixXd motion;           ///< (3 n_points + 2 n_nodes × m) of each coordinate
  [[nodiscard]] Eigen::Index vertical(std::size_t point) const { return 3 * static_cast<Eigen::Index>(point) + 2; }
  [[nodiscard]] Eigen::Index lateral_row(std::size_t node) const {
    return 3 * static_cast<Eigen::Index>(points.size()) + 2 * static_cast<Eigen::Index>(node);
  }
  [[nodiscard]] Eigen::Index vertical_row(std::size_t node) const { return lateral_row(node) + 1; }
};
[[nodiscard]] Sensors find_sensors(const LoadedModel& loaded, const WindModel& model, const Eigen::MatrixXd& vectors);

/// What the step reads.
struct ValidationInputs {
  wind::TurbulenceSet turbulence;
  AerodynamicsConfig aerodynamics;          ///< of step 7
  ReadModel model;                          ///< the updated one
  std::vector<aero::SectionAero> sections;  ///< of the set, at the level that step 7 fitted
  MeasuredRms measured;
};
[[nodiscard]] ValidationInputs read_validation_inputs(const ValidationConfig& config, StepContext& context);

/// The updated bridge prepared for turbulent wind.
struct BridgeInWind {
  LoadedModel loaded;
  AerodynamicsConfig aerodynamics;
  std::vector<aero::SectionAero> sections;
  WindModel model;
  DampedModel reduced;  ///< with dampers or without, modes and static shapes
  Sensors sensors;
  double frozen_omega = 0.0;  ///< of mode 1: at which derivatives are taken in time
};
[[nodiscard]] BridgeInWind prepare_bridge_in_wind(const ValidationConfig& config, const ValidationInputs& read);

/// The deployment that a run names. @throws InputError for an unknown model
[[nodiscard]] aero::Deployment deployment_of(const AerodynamicsConfig& config, const std::string& model);
[[nodiscard]] aero::AeroelasticSystem system_of(const BridgeInWind& bridge, const aero::Deployment& deployment);

/// v' or w' at the aerodynamic nodes in a mean wind.
[[nodiscard]] wind::FieldDefinition field_at_nodes(const BridgeInWind& bridge, const wind::TurbulenceSet& set, double height_m,
                                                   double speed_m_s, wind::Component component, bool frozen);

}  // namespace twindeck::steps
