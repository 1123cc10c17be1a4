#pragma once

#include <Eigen/Core>

#include "identification/identify.hpp"

namespace twindeck::identification {

/// Modes of a structure whose excitation was measured (base motion in an earthquake, a shaker): poles of the system from inputs
/// u to outputs y, so that peaks in the spectrum of the excitation do not appear as modes. Subspace method PO-MOESP: with the
/// LQ decomposition of
///
///     [U_future; (U, Y)_past; Y_future] = L Q,
///
/// the block of Y_future on (U, Y)_past has the range of the observability matrix. L is the Cholesky factor of the Gram matrix,
/// as in ssi_data. Standard deviations by the jackknife over `n_blocks` stretches of the Hankel matrices' columns.
/// @param inputs (n_samples × n_inputs), outputs (n_samples × n_outputs): detrended, one rate
/// @throws InputError  if the record is too short, or if an input does not excite (a constant one)
/// Reference: Verhaegen (1994), Automatica 30(1), 61-74.
[[nodiscard]] Identification identify_input_output(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs,
                                                   double rate_Hz, const IdentifyOptions& options, int n_blocks = 10);

}  // namespace twindeck::identification
