#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"

namespace twindeck::buffeting {

/// RMS of the vertical acceleration at a monitoring point, computed in two ways.
struct TimeCheck {
  std::string name, channel;
  double reference_m_s2 = 0.0, found_m_s2 = 0.0, allowed_pct = 1.0;
};
/// An event and a run in it that is stable at the wind speed of the event.
struct CheckedCase {
  WindEvent event;
  ValidationRun run;
};
/// @param seed  of the gusts
/// `half_step`: one event and run, one seed, at half the time step. `full_model`: the same gust forces on the reduced
/// structure and on the whole finite element model, dampers included, from rest, both with the same Rayleigh damping and
/// without self-excited forces (which are forces of the strips alone, the same in both); left out where full_model_check is 0.
[[nodiscard]] std::vector<TimeCheck> check_time_integration(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                                            const WindEventSettings& config, const CheckedCase& checked,
                                                            std::uint64_t seed);

/// Rayleigh damping C = mass_part M + stiffness_part K, with a ratio at two circular frequencies.
struct RayleighDamping {
  double mass_part = 0.0, stiffness_part = 0.0;  ///< [1/s], [s]
  static RayleighDamping with_ratio(double ratio, double omega1, double omega2);
};

/// Newmark's method (constant average acceleration) on a whole finite element model with its dampers, from rest: what a reduced
/// structure is checked against. One sparse factorisation, a solve a step.
///
/// A Maxwell unit is eliminated step by step: by the trapezoidal rule its force is a k c'/(k + c') spring, c' = 2c/dt, with a
/// memory.
/// @param patterns   (n × k) load patterns over the free degrees of freedom
/// @param amplitude  (k × n_steps) at t = 0, dt, …
/// @param observed   (n_observed × n) rows over the free degrees of freedom
/// @return accelerations (n_observed × n_steps)
[[nodiscard]] Eigen::MatrixXd full_model_history(const dynamics::LoadedModel& loaded,
                                                 const std::vector<const fe::Spring*>& dampers, const RayleighDamping& damping,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& patterns,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& amplitude,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& observed, double step_s);

}  // namespace twindeck::buffeting
