#include "buffeting/simulated_runs.hpp"

#include <mutex>
#include <numbers>
#include <utility>

#include "buffeting/loads.hpp"
#include "buffeting/response.hpp"
#include "buffeting/spectral.hpp"
#include "core/parallel.hpp"

namespace twindeck::buffeting {

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

Prepared prepare(const BridgeInWind& bridge, const WindEventSettings& config, const WindEvent& event, const ValidationRun& run,
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
  SpectralOptions options;
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

}  // namespace

SimulatedEvent simulate_event(const BridgeInWind& bridge, const wind::TurbulenceSet& set, const WindEventSettings& config,
                              const WindEvent& event, std::uint64_t first_seed, const Reporter& reporter) {
  wind::SimulationOptions options;
  options.duration_s = config.duration_s;
  options.rate_Hz = 1.0 / config.step_s;
  options.cutoff_Hz = config.cutoff_Hz;
  options.anchors = static_cast<int>(config.anchors);
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
    const std::uint64_t own = first_seed * 1000003 + static_cast<std::uint64_t>(seed);
    const Index strips = along.field().size();
    MatrixXd gusts(along.n_samples(), 2 * strips);
    gusts << along.sample(own), vertical.sample(own);
    statistics.add(seed, gusts);
    for (Prepared& run : prepared) {
      const Response response =
          buffeting::respond(run.newmark, run.load, gusts, config.step_s, bridge.sensors.motion, {config.lead_in_s});
      run.result.rms.col(seed) = buffeting::root_mean_squares(response.acceleration_m_s2);
      run.result.peak.col(seed) = response.acceleration_m_s2.cwiseAbs().colwise().maxCoeff().transpose();
    }
    const std::scoped_lock lock(counting);
    reporter.progress(event.name, static_cast<double>(++done), static_cast<double>(config.seeds));
  });
  SimulatedEvent simulated;
  for (Prepared& run : prepared) simulated.runs.push_back(std::move(run.result));
  simulated.checks = statistics.checks();
  return simulated;
}

}  // namespace twindeck::buffeting
