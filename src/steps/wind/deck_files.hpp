#pragma once

#include <vector>

#include "aero/wind_model.hpp"
#include "runner/run_step.hpp"
#include "steps/wind/aerodynamics_config.hpp"

/// The files of aerodynamic data that a configuration of step 7 names; steps 0, 7 and 8 read them.
namespace twindeck::steps {

/// @param context  registers the files as inputs
/// @throws InputError  also for data that break a law of aero/laws.hpp without an exception that says why, and for an exception
///                     whose law holds
[[nodiscard]] std::vector<aero::DeckAerodynamics> read_deck_aerodynamics(const aero::WindSettings& config,
                                                                         runner::StepContext& context);

}  // namespace twindeck::steps
