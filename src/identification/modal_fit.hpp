#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "identification/uncertainty.hpp"

namespace twindeck::identification {

/// A mode of a modal model that was fitted to frequency response functions.
struct FittedMode {
  std::complex<double> eigenvalue;  ///< [rad/s]
  Eigen::VectorXcd shape;           ///< (n_outputs) unit norm
  ModeDeviation deviation;          ///< from the residuals, see fit_modes
};

/// Frequency response functions to which a modal model is fitted.
struct ResponseData {
  Eigen::VectorXd frequency_Hz;  ///< (n_lines) ascending, above 0
  Eigen::MatrixXcd values;       ///< (n_lines × n_outputs n_inputs) column output · n_inputs + input
  Eigen::Index n_inputs = 1;
  int derivative = 2;  ///< 2: acceleration over force, 1: velocity, 0: displacement
};

/// Least squares of the modal model, with s = i omega,
///
///     H_oi(s) = s^d [ sum over modes of  R_oi / (s - lambda) + conj(R_oi) / (s - conj(lambda))
///                     + L2_oi / omega^4 + L1_oi / omega^2 + U0_oi + U1_oi omega^2 ],
///
/// over all its parameters: the poles lambda, the residues R, and the real lower and upper residual terms L and U of the modes
/// outside the band. The poles go by Gauss-Newton on the functions from which the part that the linear parameters explain is
/// projected out (variable projection). Each function weighs with the inverse of its own residuals. A shape is the leading
/// singular vector of the residue matrix (n_outputs × n_inputs).
///
/// The deviations come from the residuals of the fit, line by line (White's covariance with its leverage correction HC3), so
/// that noise may differ between lines; no coherence is used. The change of each value when L2 and U1 are left out is added as
/// root of the sum of squares: it stands for modes outside the band that the residual terms do not describe.
/// @param start  poles to start from, at least one, distinct
/// @return one an entry of `start`, in its order. A pole that the functions do not determine has a large deviation.
/// Reference: Golub and Pereyra (1973), SIAM J. Numer. Anal. 10, 413-432; MacKinnon and White (1985), J. Econometrics 29,
/// 305-325.
[[nodiscard]] std::vector<FittedMode> fit_modes(const ResponseData& data, std::vector<std::complex<double>> start);

}  // namespace twindeck::identification
