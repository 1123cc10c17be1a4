#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::sensitivity {

struct SensitivityOptions {
  int n_modes = 15;
  double forward_step = 0.01;         ///< of Eq. (6), relative to the parameter (to its range where it is 0)
  double frequency_change = 5e-4;     ///< relative change of the most sensitive frequency that central differences aim at
  double largest_central_step = 0.1;  ///< relative to the parameter, whatever the aim
};

/// Frequency sensitivities of one frozen system, three ways. Matrices are [Hz per unit of parameter] (n_modes × n_parameters);
/// modes are followed by mass-weighted MAC.
struct Sensitivities {
  Eigen::VectorXd frequency_Hz;  ///< (n_modes)
  Eigen::VectorXd theta;         ///< (n_parameters) values at which the derivatives are taken
  Eigen::VectorXd scale;         ///< (n_parameters) |p|, or the range where p = 0
  Eigen::MatrixXd exact;         ///< df_i/dp_j = phi_i'(dK - lambda_i dM)phi_i / (8 pi² f_i)
  Eigen::MatrixXd richardson;    ///< central differences D(h), D(h/2) extrapolated: (4 D(h/2) - D(h))/3, error O(h⁴)
  Eigen::MatrixXd forward;       ///< paper Eq. (6): (f_i(p_j + dp_j) - f_i(p_j))/dp_j, error O(dp)
  Status status;

  /// d ln f / d ln p [-] from `exact`.
  [[nodiscard]] Eigen::MatrixXd relative() const;
};

/// @param theta [parameters' units]
/// @param progress  called with the number of parameters done; may be empty
/// Results do not depend on the number of threads: each parameter has its own solver.
/// Reference: Fox and Kapoor (1968), AIAA Journal 6(12), 2426-2429; paper Eq. (6).
[[nodiscard]] Sensitivities frequency_sensitivities(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                                    const SensitivityOptions& options,
                                                    const std::function<void(int done, int of)>& progress);

/// @param source  the model, for the message
/// @throws InputError  if a mode has no frequency that could change: the structure is free, or one mass or stiffness is so
///         large that the rest is rounding beside it
void refuse_rigid_bodies(const Sensitivities& found, const std::string& source);

/// A of selection.hpp: shift of each compared frequency, in its standard deviations, over half the range of each parameter [-]
/// (n_compared × n_parameters).
/// @param compared_modes  numbers from 1; empty: all
[[nodiscard]] Eigen::MatrixXd scaled_sensitivity(const std::vector<double>& compared_modes, double frequency_std_pct,
                                                 const std::vector<fe::Parameter>& parameters, const Sensitivities& found);

}  // namespace twindeck::sensitivity
