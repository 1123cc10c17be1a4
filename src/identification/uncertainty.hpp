#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/perturbation.hpp"
#include "signal/correlation.hpp"

namespace twindeck::identification {

/// Standard deviations of one identified mode.
struct ModeDeviation {
  double frequency_Hz = 0.0;  ///< from the data's covariance; an Identification's also holds the scatter over model orders
  double damping_ratio = 0.0;
  Eigen::VectorXd shape_real, shape_imag;  ///< (n_outputs) of the entries of the unit-norm shape
  /// (2 + 2 n_outputs × n_changes) frequency [Hz], damping ratio, real and imaginary parts of the shape: F Fᵀ is the covariance
  /// of these values, and F_1 F_2ᵀ the covariance between two modes of the same record.
  Eigen::MatrixXd factor;
};

/// Independent changes whose sum of squares is the covariance of the matrix H that was decomposed.
using Changes = std::vector<SubspaceChange>;

/// First-order changes of every pole under each of the changes, rows as in ModeDeviation::factor.
struct PoleFactors {
  std::vector<std::vector<Eigen::MatrixXd>> of;  ///< [order][pole] (2 + 2 n_outputs × n_changes)
};
[[nodiscard]] PoleFactors pole_factors(const Observability& observability, const ShiftModels& models, const Changes& changes);

/// Standard deviation of a pole's frequency [Hz]. @param pole  of the models
[[nodiscard]] double frequency_deviation(const ShiftModels& models, const PoleFactors& factors, const Pole& pole);

/// Standard deviation of the difference of two poles' frequencies [Hz]. Their correlation counts: the halves of a split pole
/// move in opposite directions.
[[nodiscard]] double difference_deviation(const ShiftModels& models, const PoleFactors& factors, const Pole& pole,
                                          const Pole& other);

/// Standard deviations from a factor: the norms of its rows. @param factor  as in ModeDeviation
[[nodiscard]] ModeDeviation deviation_of_factor(Eigen::MatrixXd factor);

/// Deviations of modes whose frequency, damping and shape entries are medians over model orders. For each change, the median of
/// the members' changes is used.
/// @param modes  for each mode its poles, each of the model of its own order
[[nodiscard]] std::vector<ModeDeviation> mode_deviations(const ShiftModels& models, const PoleFactors& factors,
                                                         const std::vector<std::vector<Pole>>& modes);

/// Covariance of the correlations from the scatter between blocks, as changes of the lags: with w_b the share of block b's
/// products in the mean of all,  dR_b = w_b sqrt(n_b/(n_b - 1)) (R_b - R),  so that  cov(R) = sum over b of vec(dR_b)
/// vec(dR_b)'. Blocks must be longer than the decay time of the correlations (1/(zeta omega) of the lowest mode), so that they
/// are independent.
/// @return lags 0 … n_lags - 1, each (n_outputs × n_references)
[[nodiscard]] std::vector<Eigen::MatrixXd> lag_change(const signal::BlockCorrelations& blocks,
                                                      const std::vector<Eigen::MatrixXd>& mean, Eigen::Index block);

/// Changes of the block Toeplitz matrix of ssi_cov from those of the correlations.
[[nodiscard]] Changes covariance_changes(const signal::BlockCorrelations& blocks, Eigen::Index block_rows,
                                         const Observability& observability, const ShiftModels& models);

}  // namespace twindeck::identification
