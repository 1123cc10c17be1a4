#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::signal {

/// Output correlations of successive stretches ("blocks") of one or several records, all pairs of samples used:
///
///     R_k(i, j) = 1/n_k sum_t y_i(t + k) y_j(t),   t in the block, j a reference,   n_k pairs (unbiased).
///
/// A block's t + k may reach into the next block, so the weighted mean over blocks is the unbiased correlation of the whole
/// record, and the scatter between blocks gives its covariance.
struct BlockCorrelations {
  Eigen::Index n_outputs = 0, n_references = 0, n_lags = 0;  ///< lags 0 … n_lags - 1
  Eigen::MatrixXd sums;  ///< (n_outputs n_references n_lags × n_blocks) sums over t; lag slowest, then reference, then output
  Eigen::MatrixXd counts;  ///< (n_lags × n_blocks) n_k

  [[nodiscard]] Eigen::Index n_blocks() const { return sums.cols(); }
  /// R_k of all blocks but `without` (-1: of all). @return one (n_outputs × n_references) a lag
  [[nodiscard]] std::vector<Eigen::MatrixXd> mean(Eigen::Index without = -1) const;
  /// Adds the blocks of another record of the same channels.
  void append(const BlockCorrelations& other);
};

/// By the FFT of short overlapping pieces: exact (no wrap-around), one inverse transform per pair of channels and block.
/// @param data        (n_samples × n_outputs), detrended
/// @param references  positions of the reference channels
/// @param n_lags      number of lags, from 0
/// @param n_blocks    stretches of equal length (the last may be a little longer)
/// @throws InputError  if a block is shorter than 2 n_lags
[[nodiscard]] BlockCorrelations correlations(const Eigen::Ref<const Eigen::MatrixXd>& data,
                                             const std::vector<Eigen::Index>& references, Eigen::Index n_lags,
                                             Eigen::Index n_blocks);

}  // namespace twindeck::signal
