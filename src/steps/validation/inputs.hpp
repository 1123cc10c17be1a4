#pragma once

#include <vector>

#include "dynamics/loaded_model.hpp"
#include "runner/run_step.hpp"
#include "steps/validation/measured.hpp"
#include "steps/wind/aerodynamics_config.hpp"
#include "steps/wind/validation_config.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::steps {

/// What the step reads.
struct ValidationInputs {
  wind::TurbulenceSet turbulence;
  aero::WindSettings aerodynamics;          ///< of step 7
  dynamics::ReadModel model;                ///< the updated one
  std::vector<aero::SectionAero> sections;  ///< of the set, at the level that step 7 fitted
  buffeting::MeasuredRms measured;
};
[[nodiscard]] ValidationInputs read_validation_inputs(const ValidationConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
