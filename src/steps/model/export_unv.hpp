#pragma once

#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// model.unv, a universal file: nodes (set 2411), elements (2412), a trace line a group of beams and bars (82), and each mode's
/// translations (55), mass-normalised.
/// @throws InputError  for a matrix model, which has no elements
void export_unv(const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes, const runner::StepContext& context);

}  // namespace twindeck::steps
