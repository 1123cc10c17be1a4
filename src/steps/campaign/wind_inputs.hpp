#pragma once

#include "runner/run_step.hpp"
#include "virtual_bridge/wind_records.hpp"

namespace twindeck::steps {

/// Reads what wind events of the virtual bridge rest on: the configuration of step 7 that the settings name, its decks,
/// turbulence.
[[nodiscard]] virtual_bridge::VirtualWind read_virtual_wind(runner::StepContext& context,
                                                            const virtual_bridge::CampaignSettings& settings);

}  // namespace twindeck::steps
