#pragma once

#include "dynamics/loaded_model.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// Warns of channels of the study's own campaign (data/<study>/campaign/channels.csv) that lie on no node of its model, or
/// whose direction is not known. Step 4 refuses them, but only after the identification. Without such a file, with --model, or
/// where step 3 refuses the table, nothing is said.
void warn_of_channels_off_the_model(runner::StepContext& context, const dynamics::ReadModel& model);

}  // namespace twindeck::steps
