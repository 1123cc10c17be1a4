#pragma once

#include <vector>

#include "aero/wind_model.hpp"
#include "runner/run_step.hpp"
#include "steps/wind/aerodynamics_config.hpp"
#include "steps/wind/validation_config.hpp"
#include "wind/turbulence.hpp"

/// The files of aerodynamic data that a configuration of step 7 names; steps 0, 7, 8 and 10 read them.
namespace twindeck::steps {

/// @param context  registers the files as inputs
/// @throws InputError  also for data that break a law of aero/laws.hpp without an exception that says why, and for an exception
///                     whose law holds
[[nodiscard]] std::vector<aero::DeckAerodynamics> read_deck_aerodynamics(const aero::WindSettings& config,
                                                                         runner::StepContext& context);

/// Step 7's configuration: the file that is named, or the study's s7_aerodynamics.toml where `file` is empty.
/// @throws InputError  where neither is given
[[nodiscard]] AerodynamicsConfig read_step_7(const std::string& file, runner::StepContext& context);

/// The level that step 7 fitted for a set, from its sets.csv.
/// @throws InputError  for a set that it does not have, with those that it has
[[nodiscard]] double fitted_level(runner::StepContext& context, const std::string& set);

/// The turbulence that a configuration of step 8 names: its set, with its spectrum, its coherence and its decays. Steps 8 and
/// 10 read it alike.
/// @param context  registers the files as inputs
[[nodiscard]] wind::TurbulenceSet read_turbulence(const ValidationConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
