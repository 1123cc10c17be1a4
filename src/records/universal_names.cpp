#include "records/universal_names.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace twindeck::records {

void name_by_difference(std::vector<ChannelInfo>& channels) {
  const auto tells_apart = [&](std::size_t k) {
    std::set<std::string> seen;
    return std::all_of(channels.begin(), channels.end(), [&](const ChannelInfo& c) {
      return k < c.other_names.size() && !c.other_names[k].empty() && c.other_names[k] != "NONE" &&
             seen.insert(c.other_names[k]).second;
    });
  };
  std::size_t most = 0;
  for (const ChannelInfo& channel : channels) most = std::max(most, channel.other_names.size());
  std::vector<std::size_t> telling;
  for (const std::size_t k : {0, 5, 6, 7, 4, 3, 2, 1}) {  // of other_names: five title lines, then record 6
    if (k < most && tells_apart(k)) telling.push_back(k);
  }
  for (ChannelInfo& channel : channels) {
    const std::string title = channel.other_names.front();
    std::vector<std::string> names;
    for (const std::size_t k : telling) names.push_back(channel.other_names[k]);
    const std::string point = channel.point + channel.direction;
    channel.name = !names.empty() ? names.front() : title.empty() || title == "NONE" ? point : title;
    channel.other_names = std::move(names);
  }
}

}  // namespace twindeck::records
