#pragma once

#include <filesystem>
#include <vector>

#include "steps/validation/validation.hpp"

namespace twindeck::steps {

/// statements.csv: `statement,found,verdict`: what section 6 says about Table 13, hit or miss on ours; no rows where the
/// simulations NS1 to NS3, the events August and April or the channels M1 to M8 are not all there with a measured side.
void write_statements(const std::vector<RunResult>& results, const BridgeInWind& bridge, const MeasuredRms& measured,
                      const std::filesystem::path& folder);

}  // namespace twindeck::steps
