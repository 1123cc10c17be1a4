#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reliability/visible_loss.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// A measured mode that the updated model has too.
struct MonitoredName {
  std::string measured;  ///< its name in the measurement
  reliability::MonitoredMode mode;
};
/// The pairs of step 6's comparison.csv whose measured frequency has a standard deviation. A warning says so where there are
/// none.
/// @param condition  of the measured features, as in step 6
[[nodiscard]] std::vector<MonitoredName> read_monitored(runner::StepContext& context, const std::string& condition);

/// visible.csv, a row a section of each wall:
/// `wall,section,wall_thickness_m,smallest_loss_m,share_pct,years,located_loss_m,distance,mode,change_pct`: the smallest loss
/// of a surface that two measurements of the frequencies reveal, when it is reached, from which loss on it is told from losses
/// of other walls, and the mode that says most. visible_modes.csv:
/// `wall,experimental_mode,numerical_mode,deviation_pct,change_pct`.
void write_visible(const std::vector<reliability::VisibleLoss>& losses, const std::vector<reliability::Wall>& walls,
                   const std::vector<MonitoredName>& monitored, const std::filesystem::path& folder);

}  // namespace twindeck::steps
