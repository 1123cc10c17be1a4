#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::transient {

/// A damper with a threshold, between a degree of freedom u and ground: a mount (spring k and a little damping c_m in parallel)
/// in series with a dashpot c that is held by friction until the force exceeds it:
///
///     F = k (u - x) + c_m (u' - x'),     x' = g(F) = sign(F) max(0, |F| - F_c) / c .
///
/// Below the threshold the dashpot sticks and the mount stiffens the structure. Above it the dashpot slides and dissipates.
struct SlidingDamper {
  double stiffness_N_m = 0.0;        ///< k: anchorage of a viscous damper; the spring of an elastic-viscous one
  double mount_damping_N_s_m = 0.0;  ///< c_m
  double damping_N_s_m = 0.0;        ///< c
  double friction_N = 0.0;           ///< F_c
  [[nodiscard]] double slip_rate(double force_N) const;  ///< g(F) [m/s]
};

/// Equivalent linearisation of g under the forces of a record, in the mean square: g(F) ≈ s F with
///
///     s = E[F g(F)] / E[F²]   [m/(N s)],
///
/// 0 for a damper that never slides, 1/c for one without friction. @param force_N (n_samples)
/// Reference: Roberts and Spanos (1990), Random Vibration and Statistical Linearization, section 5.2.
[[nodiscard]] double equivalent_slip(const SlidingDamper& damper, const Eigen::Ref<const Eigen::VectorXd>& force_N);

/// Complex eigenvalues of a structure in modal coordinates with dampers linearised by their equivalent slip:
///     q'' + 2 zeta omega q' + omega² q + B' F = 0,   u = B q,   F = (k (u - x) + c_m u') / (1 + c_m s),   x' = s F.
struct LinearisedModes {
  Eigen::VectorXd frequency_Hz;   ///< ascending, |lambda|/(2 pi)
  Eigen::VectorXd damping_ratio;  ///< [-]
  Eigen::MatrixXcd shapes;        ///< (r × n) in modal coordinates, the leading entry real and positive
};
/// @param omega_rad_s, damping_ratio (r) @param at_dampers B (n_dampers × r) @param slip s (n_dampers)
/// @return modes below `highest_Hz`
[[nodiscard]] LinearisedModes linearised_modes(const Eigen::VectorXd& omega_rad_s, const Eigen::VectorXd& damping_ratio,
                                               const Eigen::MatrixXd& at_dampers, const std::vector<SlidingDamper>& dampers,
                                               const Eigen::VectorXd& slip, double highest_Hz);

}  // namespace twindeck::transient
