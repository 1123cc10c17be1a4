/// A campaign folder whose channels.csv is the input.
#include "fuzz/target.hpp"
#include "records/campaign.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  return fuzz::read_folder("campaign/campaign", "channels.csv", data, size, [](const auto& folder) {
    static_cast<void>(records::record_groups(records::read_campaign(folder), {}));
  });
}
