#pragma once

#include <map>
#include <string>
#include <utility>

#include "buffeting/paper_statements.hpp"
#include "fe/model.hpp"
#include "runner/run_step.hpp"
#include "steps/wind/validation_config.hpp"

namespace twindeck::steps {

/// RMS of the vertical acceleration in the campaign's wind records, by event and channel [m/s²], over all records that have the
/// channel. A channel counts for the monitoring point whose name it has, if it can be that point's vertical acceleration: an
/// acceleration, of role "response", vertical (up or down), and within `sensor_tolerance` of the point where its position is
/// given. A channel that has the name and is something else is left out with a warning. Empty for events whose condition is
/// not named. `--campaign`, or the study's s0_campaign.
/// @throws InputError  if the campaign is there but has no wind record of a condition that is named

[[nodiscard]] buffeting::MeasuredRms measured_rms(runner::StepContext& context, const ValidationConfig& config,
                                                  const fe::Model& model);

}  // namespace twindeck::steps
