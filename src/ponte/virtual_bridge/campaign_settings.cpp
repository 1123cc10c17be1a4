#include "ponte/virtual_bridge/campaign_settings.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::ponte {

const ConditionSettings& CampaignSettings::condition(const std::string& name) const {
  if (const auto at = std::ranges::find(conditions, name, &ConditionSettings::name); at != conditions.end()) return *at;
  throw InputError({"", 0, "condition"},
                   "'" + name + "' is not there" + did_you_mean(name, each_of(conditions, &ConditionSettings::name)),
                   "add a table [[condition]] of this name");
}

}  // namespace twindeck::ponte
