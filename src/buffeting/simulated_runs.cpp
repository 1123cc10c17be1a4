#include "buffeting/simulated_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "aero/stability.hpp"
#include "buffeting/loads.hpp"
#include "buffeting/response.hpp"
#include "buffeting/spectral.hpp"
#include "core/parallel.hpp"

namespace twindeck::buffeting {

using Eigen::MatrixXd;

namespace {

/// A stable run in an event, with everything that does not depend on the seed.
struct Prepared {
  std::size_t run = 0;  ///< position among the event's
  MatrixXd load;
  transient::Newmark newmark;
};

constexpr double kLowestDerivatives_Hz = 0.2;  ///< lower frequencies use the derivatives of this one; below all modes

/// Whether the response in this wind is stationary, both as it is integrated in time and in the frequency domain.
Status stability(const BridgeInWind& bridge, const WindEventSettings& config, const WindEvent& event, const ValidationRun& run,
                 const aero::AeroelasticSystem& system) {
  const double turn = 2.0 * std::numbers::pi;
  const std::optional<aero::Growth> growth = aero::find_growth(
      system, event.speed_m_s,
      {bridge.frozen_omega, {turn * kLowestDerivatives_Hz, turn * std::max(config.cutoff_Hz, kLowestDerivatives_Hz)}});
  if (!growth) return {};
  return {false, fmt::format("event {} at {:.4g} m/s, run {} (model {}): the bridge is unstable, {}{}", event.name,
                             event.speed_m_s, run.name, run.model, growth->in_words(),
                             growth->at_own_frequency ? " by the derivatives of its own frequency" : "")};
}

void add_spectral_values(RunResult& result, const BridgeInWind& bridge, const WindEventSettings& config, double speed_m_s,
                         const aero::AeroelasticSystem& system, const MatrixXd& load,
                         const std::vector<wind::FieldDefinition>& fields) {
  const Eigen::VectorXd f = spectral_frequencies(config.cutoff_Hz);
  SpectralOptions options;
  options.lowest_omega = 2.0 * std::numbers::pi * kLowestDerivatives_Hz;
  const auto points = static_cast<Eigen::Index>(3 * bridge.sensors.points.size());  // of the monitoring points alone
  const auto rms = [&] {
    return buffeting::band_rms(
        f, buffeting::response_spectra(system, speed_m_s, load, fields, bridge.sensors.motion.topRows(points), f, options));
  };
  result.spectral_rms_each_frequency = rms();
  options.frozen_omega = bridge.frozen_omega;
  result.spectral_rms = rms();
}

/// Results that do not depend on the seed, and the stable runs with the data that every seed needs.
struct Start {
  std::vector<RunResult> results;
  std::vector<Prepared> stable;
};

Start prepare(const BridgeInWind& bridge, const WindEventSettings& config, const WindEvent& event,
              const std::vector<wind::FieldDefinition>& fields) {
  Start start;
  for (const ValidationRun& run : config.runs) {
    const aero::AeroelasticSystem system = system_of(bridge, deployment_of(bridge.aerodynamics, run.model));
    RunResult result{event.name, run.name, run.model, {}, {}, {}, {}, stability(bridge, config, event, run, system)};
    if (result.status.converged) {
      const MatrixXd load = buffeting::load_matrix(system, event.speed_m_s, config.equations, config.components());
      result.rms.resize(bridge.sensors.motion.rows(), config.seeds);
      result.peak = result.rms;
      add_spectral_values(result, bridge, config, event.speed_m_s, system, load, fields);
      start.stable.push_back(
          {start.results.size(), load,
           transient::Newmark(buffeting::equations_of_motion(system, event.speed_m_s, bridge.frozen_omega), config.step_s)});
    }
    start.results.push_back(std::move(result));
  }
  return start;
}

}  // namespace

SimulatedEvent simulate_event(const BridgeInWind& bridge, const wind::TurbulenceSet& set, const WindEventSettings& config,
                              const WindEvent& event, std::uint64_t first_seed, const Reporter& reporter) {
  const Gusts gusts(bridge, set, config, event.speed_m_s, config.step_s);
  Start start = prepare(bridge, config, event, fields_at_nodes(bridge, set, config, event.speed_m_s));
  if (start.stable.empty()) return {std::move(start.results), {}};
  FieldStatistics statistics(event.name, gusts.simulators(), config.seeds);

  const auto run_seed = [&](long seed) {
    const std::uint64_t own = first_seed * 1000003 + static_cast<std::uint64_t>(seed);
    const MatrixXd sample = gusts.sample(own);
    statistics.add(seed, sample.bottomRows(sample.rows() - gusts.before()));
    for (const Prepared& run : start.stable) {
      const Response response = buffeting::respond(run.newmark, run.load, sample, config.step_s, bridge.sensors.motion,
                                                   {config.lead_in_s, config.repeats()});
      RunResult& result = start.results[run.run];
      result.rms.col(seed) = buffeting::root_mean_squares(response.acceleration_m_s2);
      result.peak.col(seed) = response.acceleration_m_s2.cwiseAbs().colwise().maxCoeff().transpose();
    }
  };
  parallel_for_told(config.seeds, run_seed, [&](int done, int of) { reporter.progress(event.name, done, of); });
  return {std::move(start.results), statistics.checks()};
}

}  // namespace twindeck::buffeting
