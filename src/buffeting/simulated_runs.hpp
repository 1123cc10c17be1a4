#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/field_statistics.hpp"
#include "core/reporter.hpp"

/// Accelerations of a bridge in turbulent wind, over many samples of the turbulence (paper section 6, Table 13).
namespace twindeck::buffeting {

/// Results of an event and a run: a row a sensor, a column a seed. Empty matrices where the bridge is unstable in that wind.
struct RunResult {
  std::string event, run, model;
  Eigen::MatrixXd rms, peak;                    ///< [m/s²] (n_sensors × n_seeds)
  Eigen::VectorXd spectral_rms;                 ///< (n_sensors) frequency domain, derivatives frozen as in time
  Eigen::VectorXd spectral_rms_each_frequency;  ///< the same with derivatives at each frequency's own
  Status status;  ///< not converged: names the event, its speed, the run and the motion that grows
};

/// The simulations of one event, and the statistics of its samples beside their targets.
struct SimulatedEvent {
  std::vector<RunResult> runs;
  std::vector<FieldCheck> checks;
};
/// Every seed draws its own wind and runs all simulations in it; seeds run in parallel and do not depend on how many threads
/// there are. A run in whose wind a motion grows has no stationary response, so it is not simulated. If that holds for all
/// runs, no wind is drawn and there are no checks.
/// @param first_seed  from which those of the samples come
[[nodiscard]] SimulatedEvent simulate_event(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                            const WindEventSettings& config, const WindEvent& event, std::uint64_t first_seed,
                                            const Reporter& reporter);

}  // namespace twindeck::buffeting
