#include "steps/validation/validation.hpp"

#include <fmt/format.h>

#include <utility>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/simulated_runs.hpp"
#include "buffeting/time_checks.hpp"
#include "steps/validation/inputs.hpp"
#include "steps/validation/outputs.hpp"
#include "steps/validation/statements.hpp"

namespace twindeck::steps {

namespace {

Status run_validation(runner::StepContext& context, const ValidationConfig& config, const ValidationInputs& read) {
  // 1. The bridge, reduced, and the turbulence.
  const wind::TurbulenceSet& set = read.turbulence;
  const buffeting::BridgeInWind bridge =
      buffeting::prepare_bridge_in_wind(config, read.aerodynamics, read.model, read.sections);
  if (!bridge.loaded.state.status.converged) return bridge.loaded.state.status;
  if (!bridge.model.modes.status.converged) return bridge.model.modes.status;
  context.say(fmt::format("{} coordinates for {} degrees of freedom, {} aerodynamic nodes, {} dampers",
                          bridge.reduced.structure.size(), bridge.loaded.system.size(), bridge.model.strips.size(),
                          bridge.reduced.dampers));

  // 2. Events one after the other, seeds in parallel.
  std::vector<buffeting::RunResult> results;
  std::vector<buffeting::FieldCheck> checks;
  for (const buffeting::WindEvent& event : config.events) {
    buffeting::SimulatedEvent simulated = buffeting::simulate_event(bridge, set, config, event, context.seed, context);
    for (buffeting::RunResult& result : simulated.runs) results.push_back(std::move(result));
    checks.insert(checks.end(), simulated.checks.begin(), simulated.checks.end());
  }

  // 3. Tables.
  write_rms(results, bridge, read.measured, config, context.out);
  write_statements(results, bridge, read.measured, context.out);
  write_comfort(results, bridge, config, context.out);
  write_wind_check(checks, context.out);
  write_hybrid(bridge, context.out);
  write_time_checks(buffeting::check_time_integration(bridge, set, config, context.seed), context.out);
  return {};
}

}  // namespace

runner::Computation read_validation(runner::StepContext& context, const ValidationConfig& config) {
  return [&context, &config, read = read_validation_inputs(config, context)] { return run_validation(context, config, read); };
}

}  // namespace twindeck::steps
