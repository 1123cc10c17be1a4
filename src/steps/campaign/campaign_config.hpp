#pragma once

#include "io/config.hpp"
#include "virtual_bridge/campaign_settings.hpp"

namespace twindeck::steps {

/// Configuration of s0_campaign.
struct CampaignConfig : virtual_bridge::CampaignSettings {
  [[nodiscard]] io::FieldTable fields();
};

}  // namespace twindeck::steps
