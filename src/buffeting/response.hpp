#pragma once

#include <Eigen/Core>

#include "aero/aeroelastic_system.hpp"
#include "transient/newmark.hpp"
#include "wind/simulation.hpp"

namespace twindeck::buffeting {

/// A reduced structure in wind as equations in time:  q̈ + (C - Ca) q̇ + (Λ - Ka) q = f. Flutter derivatives hold for harmonic
/// motion. In time they are frozen at one frequency (the paper does not state which). Maxwell units get further coordinates at
/// the end.
[[nodiscard]] transient::LinearSystem equations_of_motion(const aero::AeroelasticSystem& system, double speed_m_s,
                                                          double frozen_omega_rad_s);

/// Accelerations at sensors under one sample of turbulence.
struct ResponseOptions {
  double lead_in_s = 60.0;  ///< run-up before the record
  /// true: the sample is periodic, and the run-up is its end; for a longer run-up the sample repeats. false: the run-up is the
  /// first part of the sample, and the record is the rest.
  bool repeats = true;
};
struct Response {
  Eigen::MatrixXd acceleration_m_s2;  ///< (n_steps × n_sensors) of the record
};
/// @param newmark        of equations_of_motion, its step that of the wind
/// @param load           (m × n_inputs) of load_matrix
/// @param wind_m_s       (n_steps × n_inputs) gusts of every strip, component by component
/// @param step_s         of the wind
/// @param sensors        (n_sensors × m) motion of each sensor per unit of each coordinate
[[nodiscard]] Response respond(const transient::Newmark& newmark, const Eigen::Ref<const Eigen::MatrixXd>& load,
                               const Eigen::Ref<const Eigen::MatrixXd>& wind_m_s, double step_s,
                               const Eigen::Ref<const Eigen::MatrixXd>& sensors, const ResponseOptions& options = {});

/// Root mean square of each column about its mean. @return (n_columns)
[[nodiscard]] Eigen::VectorXd root_mean_squares(const Eigen::Ref<const Eigen::MatrixXd>& history);

}  // namespace twindeck::buffeting
