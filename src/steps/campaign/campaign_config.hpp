#pragma once

#include "io/config.hpp"
#include "ponte/virtual_bridge/campaign_settings.hpp"

namespace twindeck::steps {

/// Configuration of s0_campaign.
struct CampaignConfig : ponte::CampaignSettings {
  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
