#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/simulated_runs.hpp"

namespace twindeck::buffeting {

/// RMS of measured accelerations by event and channel [m/s²].
using MeasuredRms = std::map<std::pair<std::string, std::string>, double>;

/// What section 6 of the paper says about its Table 13, and whether it holds here.
struct PaperStatement {
  std::string statement, found;
  bool holds = false;
};

/// Empty where the simulations NS1 to NS3, the events August and April or the channels M1 to M8 are not all there with a
/// measured side.
[[nodiscard]] std::vector<PaperStatement> paper_statements(const std::vector<RunResult>& results, const Sensors& sensors,
                                                           const MeasuredRms& measured);

}  // namespace twindeck::buffeting
