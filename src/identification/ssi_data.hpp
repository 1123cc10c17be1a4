#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/state_space.hpp"
#include "identification/uncertainty.hpp"

namespace twindeck::identification {

/// Gram matrix G = H Hᵀ of the data Hankel matrix H = [past references; future outputs],
///
///     past     r_0 … r_{p-1} (n_references p rows),   future   y_p … y_{2p-1} (n_outputs p rows),   columns t = 0 … N - 2p,
///
/// computed without H. Neighbouring blocks differ only by the products of two samples,  G_{i+1,j+1} = G_{i,j} + y_{i+n}
/// y_{j+n}ᵀ - y_i y_jᵀ  with n = N - 2p + 1 columns, and the first ones are correlations.
/// @param data (n_samples × n_outputs) detrended @param references positions of the reference channels
/// @return lower triangle filled, ((n_references + n_outputs) p square)
/// @throws InputError  if the record has fewer than 4 p samples
[[nodiscard]] Eigen::MatrixXd hankel_gram(const Eigen::Ref<const Eigen::MatrixXd>& data,
                                          const std::vector<Eigen::Index>& references, Eigen::Index block_rows);

/// Data-driven stochastic subspace identification, reference-based, unweighted principal components. With the LQ decomposition
/// of the Hankel matrix, here L = Cholesky factor of its Gram matrix (the same L up to signs), the projection of the future on
/// the past is L21 Q1ᵀ, and its leading left singular vectors are those of L21: the projection itself, which is as long as the
/// record, is never formed.
struct DataDriven {
  Observability observability;
  Eigen::MatrixXd past_factor;  ///< L11 (n_references p square), for the covariance
  Eigen::MatrixXd projection;   ///< L21 (n_outputs p × n_references p)
  double samples = 0.0;         ///< columns of the Hankel matrices
};
/// @param grams  one per record; they are added
/// @throws InputError  if there are too few block rows for n_max, or a channel depends linearly on others (the past is
/// singular) Reference: Peeters and De Roeck (1999), Mechanical Systems and Signal Processing 13(6), 855-878.
[[nodiscard]] DataDriven ssi_data(const std::vector<Eigen::MatrixXd>& grams, double samples, Eigen::Index n_references,
                                  Eigen::Index n_outputs, Eigen::Index block_rows, Eigen::Index n_max);

/// Changes of L21 from those of the correlations, to first order. L21 enters only as L21 L21ᵀ = G21 G11⁻¹ G12, which changes
/// like that of dL21 = dG21 L11⁻ᵀ - 1/2 L21 L11⁻¹ dG11 L11⁻ᵀ.
[[nodiscard]] Changes data_changes(const signal::BlockCorrelations& blocks, const std::vector<Eigen::Index>& references,
                                   Eigen::Index block_rows, const DataDriven& found, const ShiftModels& models);

}  // namespace twindeck::identification
