#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "buffeting/interval.hpp"
#include "io/config.hpp"
#include "steps/aerodynamics/aerodynamics.hpp"
#include "wind/simulation.hpp"
#include "wind/turbulence.hpp"

/// Step 8: the bridge in turbulent wind (paper sections 5.2 and 6, Tables 13, 14, Fig. 21).
namespace twindeck::steps {

struct WindEvent {
  std::string name;        ///< "August"
  double speed_m_s = 0.0;  ///< mean speed at the decks
  std::string condition;   ///< of the campaign whose wind records are the measured side; empty: none
};

/// A numerical simulation of Table 13.
struct ValidationRun {
  std::string name;   ///< "NS1"
  std::string model;  ///< of Table 11, or "hybrid"
};

/// Configuration of s8_validation; decks, data, direction and damping are those of s7_aerodynamics.toml.
struct ValidationConfig {
  std::string aerodynamics;  ///< file of step 7's configuration; empty: the study's
  std::string set = "standin";
  std::string turbulence_file = "data/wind/turbulence_sets.csv", turbulence_set = "printed";
  double height_m = 14.5;
  bool frozen = true, dampers = true;
  long seeds = 20, n_modes = 30, static_shapes = 8, point_shapes = 1, anchors = 40;
  double duration_s = 600.0, lead_in_s = 60.0, step_s = 1.0 / 64.0, cutoff_Hz = 8.0;
  double level = 0.95;
  std::string equations = "consistent";
  std::vector<WindEvent> events;
  std::vector<ValidationRun> runs;
  double comfort_vertical_m_s2 = 0.7, comfort_lateral_m_s2 = 0.1;
  double full_model_check_s = 0.0;

  [[nodiscard]] io::FieldTable fields();
  [[nodiscard]] aero::Equations equation_choice() const;
};

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

/// The updated bridge prepared for turbulent wind.
struct BridgeInWind {
  LoadedModel loaded;
  AerodynamicsConfig aerodynamics;
  std::vector<aero::SectionAero> sections;
  double level = 1.0;
  WindModel model;
  DampedModel reduced;  ///< with dampers or without, modes and static shapes
  Sensors sensors;
  double frozen_omega = 0.0;  ///< of mode 1: at which derivatives are taken in time
};
[[nodiscard]] BridgeInWind prepare_bridge_in_wind(const ValidationConfig& config, StepContext& context);

/// The deployment that a run names. @throws InputError for an unknown model
[[nodiscard]] aero::Deployment deployment_of(const AerodynamicsConfig& config, const std::string& model);
[[nodiscard]] aero::AeroelasticSystem system_of(const BridgeInWind& bridge, const aero::Deployment& deployment);

/// v' or w' at the aerodynamic nodes in a mean wind.
[[nodiscard]] wind::FieldDefinition field_at_nodes(const BridgeInWind& bridge, const wind::TurbulenceSet& set, double height_m,
                                                   double speed_m_s, wind::Component component, bool frozen);

/// Results of an event and a run: a row a sensor, a column a seed.
struct RunResult {
  std::string event, run, model;
  Eigen::MatrixXd rms, peak;                    ///< [m/s²] (n_sensors × n_seeds)
  Eigen::VectorXd spectral_rms;                 ///< (n_sensors) frequency domain, derivatives frozen as in time
  Eigen::VectorXd spectral_rms_each_frequency;  ///< the same with derivatives at each frequency's own
  Status status;
};

/// How well the samples have what they were asked to have.
struct FieldCheck {
  std::string event, quantity;
  double target = 0.0, found = 0.0, allowed = 0.0;
};

/// An RMS two ways, of the vertical acceleration at a monitoring point.
struct TimeCheck {
  std::string name, channel;
  double reference_m_s2 = 0.0, found_m_s2 = 0.0, allowed_pct = 1.0;
};
/// `half_step`: the first event and run, one seed, at half the time step. `full_model`: the same gust forces on the reduced
/// structure and on the whole finite element model, dampers included, from rest, both with the same Rayleigh damping and
/// without self-excited forces (which are forces of the strips alone, the same in both); left out where full_model_check is 0.
[[nodiscard]] std::vector<TimeCheck> check_time_integration(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                                            const ValidationConfig& config, const StepContext& context);

/// RMS of the vertical acceleration in the campaign's wind records, by event and channel [m/s²]; a channel counts for the
/// monitoring point whose name it has. Empty for events whose condition is not named. `--campaign`, or the study's s0_campaign.
/// @throws InputError  if the campaign is there but has no wind record of a condition that is named
using MeasuredRms = std::map<std::pair<std::string, std::string>, double>;
[[nodiscard]] MeasuredRms measured_rms(StepContext& context, const ValidationConfig& config);

[[nodiscard]] Status run_validation(StepContext& context, const ValidationConfig& config);

}  // namespace twindeck::steps
