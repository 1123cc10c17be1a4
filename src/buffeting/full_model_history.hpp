#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"

namespace twindeck::buffeting {

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
