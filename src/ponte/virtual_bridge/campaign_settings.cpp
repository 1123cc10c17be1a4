#include "ponte/virtual_bridge/campaign_settings.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace twindeck::ponte {

const ConditionSettings& CampaignSettings::condition(const std::string& name) const {
  const auto at =
      std::find_if(conditions.begin(), conditions.end(), [&](const ConditionSettings& c) { return c.name == name; });
  if (at != conditions.end()) return *at;
  std::vector<std::string> known;
  for (const ConditionSettings& c : conditions) known.push_back(c.name);
  throw InputError({"", 0, "condition"}, "'" + name + "' is not there" + did_you_mean(name, known),
                   "add a table [[condition]] of this name");
}

}  // namespace twindeck::ponte
