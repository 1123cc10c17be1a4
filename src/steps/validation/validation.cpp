#include "steps/validation/validation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <numbers>

#include "buffeting/loads.hpp"
#include "buffeting/response.hpp"
#include "buffeting/spectral.hpp"
#include "core/parallel.hpp"
#include "steps/validation/outputs.hpp"
#include "steps/validation/statements.hpp"

namespace twindeck::steps {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Everything about a run in an event that does not depend on the seed.
struct Prepared {
  RunResult result;
  MatrixXd load;
  transient::Newmark newmark;
};

/// Spacing of frequencies where the bridge has its modes, and above them.
constexpr double kFine_Hz = 4e-3, kFineUpTo_Hz = 3.0, kCoarse_Hz = 4e-2;

/// Frequencies to the cutoff. The trapezoid rule over a resonance of damping xi errs by exp(-2 pi xi f / spacing): 0.3 % for
/// the first mode at 0.5 %, and less for the wider ones above it.
Eigen::VectorXd spectral_frequencies(double cutoff_Hz) {
  std::vector<double> f;
  for (double x = kFine_Hz; x < cutoff_Hz; x += x < kFineUpTo_Hz ? kFine_Hz : kCoarse_Hz) f.push_back(x);
  return Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<Index>(f.size()));
}

Prepared prepare(const BridgeInWind& bridge, const ValidationConfig& config, const WindEvent& event, const ValidationRun& run,
                 const wind::FieldDefinition& along, const wind::FieldDefinition& vertical) {
  const aero::AeroelasticSystem system = system_of(bridge, deployment_of(bridge.aerodynamics, run.model));
  const MatrixXd load = buffeting::load_matrix(system, event.speed_m_s, config.equation_choice());
  RunResult result;
  result.event = event.name;
  result.run = run.name;
  result.model = run.model;
  result.rms.resize(bridge.sensors.motion.rows(), config.seeds);
  result.peak = result.rms;
  const Eigen::VectorXd f = spectral_frequencies(config.cutoff_Hz);
  buffeting::SpectralOptions options;
  options.lowest_omega = 2.0 * std::numbers::pi * 0.2;                       // well below the first mode
  const auto points = static_cast<Index>(3 * bridge.sensors.points.size());  // of the monitoring points alone
  result.spectral_rms_each_frequency =
      buffeting::band_rms(f, buffeting::response_spectra(system, event.speed_m_s, load, along, vertical,
                                                         bridge.sensors.motion.topRows(points), f, options));
  options.frozen_omega = bridge.frozen_omega;
  result.spectral_rms = buffeting::band_rms(f, buffeting::response_spectra(system, event.speed_m_s, load, along, vertical,
                                                                           bridge.sensors.motion.topRows(points), f, options));
  return {result, load,
          transient::Newmark(buffeting::equations_of_motion(system, event.speed_m_s, bridge.frozen_omega), config.step_s)};
}

Status run_validation(StepContext& context, const ValidationConfig& config, const ValidationInputs& read) {
  // 1. The bridge, reduced, and the turbulence.
  const wind::TurbulenceSet& set = read.turbulence;
  const BridgeInWind bridge = prepare_bridge_in_wind(config, read);
  if (!bridge.loaded.state.status.converged) return bridge.loaded.state.status;
  if (!bridge.model.modes.status.converged) return bridge.model.modes.status;
  context.say(fmt::format("{} coordinates for {} degrees of freedom, {} aerodynamic nodes, {} dampers",
                          bridge.reduced.structure.size(), bridge.loaded.system.size(), bridge.model.strips.size(),
                          bridge.reduced.dampers));

  // 2. Events one after the other, seeds in parallel: every seed draws its own wind and runs all simulations in it.
  wind::SimulationOptions options;
  options.duration_s = config.duration_s;
  options.rate_Hz = 1.0 / config.step_s;
  options.cutoff_Hz = config.cutoff_Hz;
  options.anchors = static_cast<int>(config.anchors);
  std::vector<RunResult> results;
  std::vector<FieldCheck> checks;
  Status status;
  for (const WindEvent& event : config.events) {
    const auto field = [&](wind::Component component) {
      return field_at_nodes(bridge, set, config.height_m, event.speed_m_s, component, config.frozen);
    };
    const wind::Simulator along(field(wind::Component::along), options), vertical(field(wind::Component::vertical), options);
    std::vector<Prepared> prepared;
    for (const ValidationRun& run : config.runs)
      prepared.push_back(prepare(bridge, config, event, run, along.field(), vertical.field()));
    FieldStatistics statistics(event.name, along, vertical, config.seeds);

    std::mutex counting;
    Index done = 0;
    parallel_for(config.seeds, [&](long seed) {
      const std::uint64_t own = context.seed * 1000003 + static_cast<std::uint64_t>(seed);
      const Index strips = along.field().size();
      MatrixXd gusts(along.n_samples(), 2 * strips);
      gusts << along.sample(own), vertical.sample(own);
      statistics.add(seed, gusts);
      for (Prepared& run : prepared) {
        const buffeting::Response response =
            buffeting::respond(run.newmark, run.load, gusts, config.step_s, bridge.sensors.motion, {config.lead_in_s});
        run.result.rms.col(seed) = buffeting::root_mean_squares(response.acceleration_m_s2);
        run.result.peak.col(seed) = response.acceleration_m_s2.cwiseAbs().colwise().maxCoeff().transpose();
      }
      const std::scoped_lock lock(counting);
      context.progress(event.name, static_cast<double>(++done), static_cast<double>(config.seeds));
    });
    for (Prepared& run : prepared) results.push_back(std::move(run.result));
    const std::vector<FieldCheck> found = statistics.checks();
    checks.insert(checks.end(), found.begin(), found.end());
  }

  // 3. Tables.
  write_rms(results, bridge, read.measured, config, context.out);
  write_statements(results, bridge, read.measured, context.out);
  write_comfort(results, bridge, config, context.out);
  write_wind_check(checks, context.out);
  write_hybrid(bridge, context.out);
  write_time_checks(check_time_integration(bridge, set, config, context), context.out);
  return status;
}

}  // namespace

Computation read_validation(StepContext& context, const ValidationConfig& config) {
  return [&context, &config, read = read_validation_inputs(config, context)] { return run_validation(context, config, read); };
}

}  // namespace twindeck::steps
