#pragma once

#include <optional>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "reliability/random_inputs.hpp"
#include "reliability/wind_law.hpp"
#include "reliability/worn_model.hpp"
#include "runner/run_step.hpp"
#include "steps/reliability/monitoring.hpp"
#include "steps/reliability/reliability_config.hpp"
#include "steps/wind/aerodynamics_config.hpp"
#include "steps/wind/deck_files.hpp"
#include "steps/wind/validation_config.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::steps {

/// What the step reads.
struct ReliabilityInputs {
  AerodynamicsConfig aerodynamics;  ///< of step 7
  std::vector<std::string> models;  ///< whose critical speeds are asked for
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
