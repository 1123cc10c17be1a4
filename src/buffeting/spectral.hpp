#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "aero/aeroelastic_system.hpp"
#include "wind/field.hpp"

namespace twindeck::buffeting {

/// Stationary response in the frequency domain, without time step and seed, with the derivatives of each frequency. It is the
/// reference for the scatter of time histories and for the error of frozen derivatives.
///
///     S_a(f) = sum over v', w' (and u') of |T(f) S_c(f) T(f)*|,   T = (i omega)^p O (-omega² + i omega C(omega) + K(omega))⁻¹
///     R,
///
/// with sensors O, loads R; p = 0 displacements, 2 accelerations.
struct SpectralOptions {
  int derivative = 2;         ///< p
  double frozen_omega = 0.0;  ///< [rad/s] at which derivatives are taken; 0: at each frequency
  double lowest_omega = 0.0;  ///< [rad/s] derivatives are constant below it, because tables end before quasi-steady motion
  /// Aerodynamic admittance on the force spectra, |chi(f)|²; empty: 1 (quasi-steady).
  std::function<double(double f_Hz)> admittance;
};

/// -omega² + i omega C + K of the system at one frequency, Maxwell units as their complex stiffness. @param air  self-excited
[[nodiscard]] Eigen::MatrixXcd impedance(const aero::AeroelasticSystem& system, const aero::AeroelasticSystem::Block& air,
                                         double omega_rad_s);

/// First-order change of a system and of its loads with one input, in the system's own coordinates.
struct SystemSlope {
  Eigen::MatrixXd mass, damping, stiffness;  ///< (m × m) the air's part included
  double maxwell = 0.0;                      ///< relative change of the Maxwell units' stiffness and damping
  Eigen::MatrixXd load;                      ///< (m × n_components n_strips); may be empty
  double turbulence = 0.0;                   ///< relative change of the standard deviations of the gusts
};
/// Change of the impedance. @return (m × m)
[[nodiscard]] Eigen::MatrixXcd impedance_slope(const aero::AeroelasticSystem& system, const SystemSlope& slope,
                                               double omega_rad_s);

/// Frequencies to the cutoff [Hz]. The trapezoid rule over a resonance of damping xi errs by exp(-2 pi xi f / spacing): 0.3 %
/// for the first mode at 0.5 %, and less for the wider ones above it.
[[nodiscard]] Eigen::VectorXd spectral_frequencies(double cutoff_Hz);

/// @param load       (m × n_components n_strips) of load_matrix
/// @param fields     the components at the strips, in the order of the load's columns; frequencies > 0
/// @param sensors    (n_sensors × m)
/// @return [unit²/Hz] one-sided (n_frequencies × n_sensors)
[[nodiscard]] Eigen::MatrixXd response_spectra(const aero::AeroelasticSystem& system, double speed_m_s,
                                               const Eigen::Ref<const Eigen::MatrixXd>& load,
                                               const std::vector<wind::FieldDefinition>& fields,
                                               const Eigen::Ref<const Eigen::MatrixXd>& sensors,
                                               const Eigen::Ref<const Eigen::VectorXd>& f_Hz,
                                               const SpectralOptions& options = {});

/// First-order change of the spectra of few sensors with each of the slopes: dT = -O Z⁻¹ dZ Z⁻¹ R + O Z⁻¹ dR. The cost of all
/// slopes together is that of a few spectra.
/// @param options  frozen_omega > 0: the air in `slopes` belongs to that frequency
/// @return [unit²/Hz] for each sensor (n_frequencies × n_slopes)
[[nodiscard]] std::vector<Eigen::MatrixXd> response_spectra_slopes(
    const aero::AeroelasticSystem& system, double speed_m_s, const Eigen::Ref<const Eigen::MatrixXd>& load,
    const std::vector<wind::FieldDefinition>& fields, const Eigen::Ref<const Eigen::MatrixXd>& sensors,
    const Eigen::Ref<const Eigen::VectorXd>& f_Hz, const std::vector<SystemSlope>& slopes, const SpectralOptions& options);

/// Square root of the integral over the frequencies (trapezoid). @return (n_columns)
[[nodiscard]] Eigen::VectorXd band_rms(const Eigen::Ref<const Eigen::VectorXd>& f_Hz,
                                       const Eigen::Ref<const Eigen::MatrixXd>& spectra);

}  // namespace twindeck::buffeting
