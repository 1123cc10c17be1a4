#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "io/config.hpp"
#include "reliability/random_inputs.hpp"
#include "reliability/visible_loss.hpp"
#include "reliability/wind_law.hpp"
#include "reliability/worn_model.hpp"
#include "runner/run_step.hpp"
#include "steps/wind/aerodynamics_config.hpp"
#include "steps/wind/deck_files.hpp"
#include "steps/wind/validation_config.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::steps {

/// A random input as the configuration states it.
struct StatedInput : reliability::RandomInput {
  double low_value = 0.0, high_value = 0.0;  ///< where `bounded` says that the law is cut
  bool bounded = false;
  StatedInput() { label = "user"; }
};

/// Sections that corrode alike.
struct StatedWall {
  std::vector<std::string> sections;
  double thickness_m = 0.0;
  long sides = 1;
  std::string category = "C3";
  double first_year_m = 0.0, exponent = 0.523, coating_life_years = 0.0;
};

/// Comfort limits of a guideline; 0: none in that direction.
struct StatedComfort {
  std::string name;
  double vertical_m_s2 = 0.0, lateral_m_s2 = 0.0;
};

struct StatedFault {
  std::string damper, kind = "held";
};

struct StatedWindLaw : reliability::WindLaw {
  std::string kind_name = "none", terrain = "II", file;
  double sector_deg = 90.0;
};

/// Configuration of s10_reliability. Decks, data and wind direction are those of s7_aerodynamics.toml; height, turbulence,
/// reduction and comfort limits those of s8_validation.toml.
struct ReliabilityConfig {
  std::vector<double> speed_m_s = {10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0};
  std::vector<std::string> models;
  std::string response_model = "A";
  double duration_s = 600.0;
  int samples = 2000, form_iterations = 200, subset_levels = 20;
  double damping_variation = 0.2, level_variation = 0.1, damper_variation = 0.05, turbulence_variation = 0.1,
         corrosion_variation = 0.3;
  std::vector<StatedInput> random;
  std::vector<std::string> rare;
  std::vector<double> years = {0.0};
  std::vector<StatedWall> walls;
  std::vector<StatedFault> faults;
  double held_stiffness_N_m = 1e7;
  std::vector<StatedComfort> comfort;
  std::string stay_class = "spiral_strand";
  double damper_stroke_m = 0.0;
  StatedWindLaw wind_law;
  std::string condition;

  [[nodiscard]] io::FieldTable fields();
};

/// A measured mode that is paired with a mode of the updated model.
struct MonitoredName {
  std::string measured;  ///< its name in the measurement
  reliability::MonitoredMode mode;
};

/// Input of the step.
struct ReliabilityInputs {
  AerodynamicsConfig aerodynamics;  ///< of step 7
  std::vector<std::string> models;  ///< deployments whose critical speeds are computed
  ValidationConfig validation;      ///< of step 8
  wind::TurbulenceSet turbulence;
  std::vector<aero::DeckAerodynamics> data;
  double level = 1.0;  ///< of the set, as step 7 fitted it
  dynamics::ReadModel model;
  reliability::RandomVector random;
  std::vector<int> parameters;  ///< of the model, in the order of the inputs "parameter:NAME"
  std::vector<reliability::Wall> walls;
  std::optional<reliability::WindLaw> law;
  std::vector<MonitoredName> monitored;  ///< empty where no wall is given
};
/// The parameters' laws are those of step 6's posterior.csv and correlations.csv where it wrote them; a note says where it did
/// not.
/// @throws InputError  for an input that is no parameter of the model and none of the step's own, with the known names
[[nodiscard]] ReliabilityInputs read_reliability_inputs(const ReliabilityConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
