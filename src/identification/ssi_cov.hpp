#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/state_space.hpp"

namespace twindeck::identification {

/// Block Toeplitz matrix of output correlations,
///
///     T = [ R_p … R_1 ; R_{p+1} … R_2 ; … ; R_{2p-1} … R_p ],   (n_outputs p × n_references p),
///
/// which for white excitation is O_p Gamma_p, observability times reversed stochastic controllability.
/// @param lags  R_0 … R_{2p-1}, each (n_outputs × n_references)
/// @param block_rows  p
/// Reference: Peeters and De Roeck (1999), Mechanical Systems and Signal Processing 13(6), 855-878.
[[nodiscard]] Eigen::MatrixXd block_toeplitz(const std::vector<Eigen::MatrixXd>& lags, Eigen::Index block_rows);

/// @throws InputError  if n_max exceeds (p - 1) n_outputs or p n_references
void require_order(Eigen::Index n_max, Eigen::Index block_rows, Eigen::Index n_outputs, Eigen::Index n_references);

/// Covariance-driven stochastic subspace identification: O = U_n S_n^(1/2) of the leading n singular triplets of T.
/// @param n_max  largest order wanted
/// @throws InputError  as require_order
[[nodiscard]] Observability ssi_cov(const std::vector<Eigen::MatrixXd>& lags, Eigen::Index block_rows, Eigen::Index n_outputs,
                                    Eigen::Index n_max);

}  // namespace twindeck::identification
