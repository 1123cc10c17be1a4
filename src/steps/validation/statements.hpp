#pragma once

#include <filesystem>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/field_statistics.hpp"
#include "buffeting/interval.hpp"
#include "buffeting/simulated_runs.hpp"
#include "buffeting/time_checks.hpp"
#include "steps/validation/measured.hpp"

namespace twindeck::steps {

/// statements.csv: `statement,found,verdict`: what section 6 says about Table 13, hit or miss on ours; no rows where the
/// simulations NS1 to NS3, the events August and April or the channels M1 to M8 are not all there with a measured side.
void write_statements(const std::vector<buffeting::RunResult>& results, const buffeting::BridgeInWind& bridge,
                      const MeasuredRms& measured, const std::filesystem::path& folder);

}  // namespace twindeck::steps
