#pragma once

#include "io/config.hpp"
#include "ponte/virtual_bridge/campaign_settings.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// Configuration of s0_campaign.
struct CampaignConfig : ponte::CampaignSettings {
  [[nodiscard]] io::FieldTable fields();
};

/// s0_campaign: simulates the test campaign on the virtual bridge and writes what its loggers wrote,
///
///     records/<setup>/<condition>_<kind><n>.npy   samples × channels, single precision, m/s²
///     campaign.toml, channels.csv, conditions.toml   as docs/my_records.md has them
///
/// and the true values, for scorers only: truth/modes.csv and truth/participation.csv (modes below 3 Hz; `mode` is empty if
/// Table 4 does not name it), truth/shapes.csv (of the named modes), truth/stays.csv, truth/dampers.csv.
/// With --calibrate: corrections.csv alone, the factors with which the bridge has the named frequencies.
[[nodiscard]] runner::Computation read_test_campaign(runner::StepContext& context, const ponte::CampaignSettings& settings);

}  // namespace twindeck::steps
