#pragma once

#include "dynamics/loaded_model.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// model.inp for CalculiX, model_abaqus.inp for Abaqus, with a message about what such a file cannot hold.
/// @throws InputError  for a matrix model, which has no elements
void export_inp(const dynamics::LoadedModel& loaded, int n_modes, const runner::StepContext& context);

}  // namespace twindeck::steps
