#include "steps/validation/validation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/paper_statements.hpp"
#include "buffeting/simulated_runs.hpp"
#include "buffeting/time_checks.hpp"
#include "steps/validation/outputs.hpp"

namespace twindeck::steps {

Status run_validation(const ValidationConfig& config, const ValidationInputs& read, runner::StepContext& context) {
  // 1. The bridge, reduced, and the turbulence.
  const wind::TurbulenceSet& set = read.turbulence;
  const buffeting::BridgeInWind bridge =
      buffeting::prepare_bridge_in_wind(config, read.aerodynamics, read.model, read.sections);
  if (!bridge.loaded.state.status.converged) return bridge.loaded.state.status;
  if (!bridge.model.modes.status.converged) return bridge.model.modes.status;
  context.say(fmt::format("{} coordinates for {} degrees of freedom, {} aerodynamic nodes, {} dampers",
                          bridge.reduced.structure.size(), bridge.loaded.system.size(), bridge.model.strips.size(),
                          bridge.reduced.dampers));

  // 2. Events one after the other, seeds in parallel. Where the bridge is unstable in a run there is nothing to publish of it.
  std::vector<buffeting::RunResult> results;
  std::vector<buffeting::FieldCheck> checks;
  std::optional<buffeting::CheckedCase> stable;
  std::vector<std::string> unstable;
  for (const buffeting::WindEvent& event : config.events) {
    buffeting::SimulatedEvent simulated = buffeting::simulate_event(bridge, set, config, event, context.seed, context);
    for (std::size_t i = 0; i < simulated.runs.size(); ++i) {
      const Status& status = simulated.runs[i].status;
      if (!status.converged) {
        unstable.push_back(status.message);
      } else if (!stable) {
        stable = {event, config.runs[i]};
      }
      results.push_back(std::move(simulated.runs[i]));
    }
    checks.insert(checks.end(), simulated.checks.begin(), simulated.checks.end());
  }

  for (const std::string& told : unstable) context.warn(told + "; its rows in rms.csv and comfort.csv are left empty");

  // 3. Tables.
  write_rms(results, bridge, read.measured, config, context.out);
  write_statements(buffeting::paper_statements(results, bridge.sensors, read.measured), context.out);
  write_comfort(results, bridge, config, context.out);
  write_wind_check(checks, context.out);
  write_hybrid(bridge, context.out);
  write_time_checks(stable ? buffeting::check_time_integration(bridge, set, config, *stable, context.seed)
                           : std::vector<buffeting::TimeCheck>(),
                    context.out);
  if (!stable) return {false, fmt::format("{}", fmt::join(unstable, "; "))};
  return {};
}

}  // namespace twindeck::steps
