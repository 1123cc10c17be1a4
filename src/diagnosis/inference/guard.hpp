#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace twindeck::diagnosis {

/// Sigma^-1 of all rows, and ln |Sigma|.
struct Precision {
  Eigen::MatrixXd matrix;
  double log_determinant = 0.0;
};
/// A hypothesis with fixed scales: the residual minus one of its signatures is N(0, Sigma).
struct Explanation {
  std::shared_ptr<const Precision> precision;
  Eigen::MatrixXd left;        ///< (n_rows × n_magnitudes) r - s; one column without a cause
  Eigen::VectorXd log_weight;  ///< (n_magnitudes) ln prior of the entry and the magnitude
};

/// Prediction of the rows that a fold leaves out.
struct BlockGain {
  double log_gain = 0.0;             ///< ln odds against "nothing" from all rows, minus those from all other rows
  double before = 0.0, after = 0.0;  ///< sums of squared standardised residuals
  int rows = 0;
  int chosen = -1;  ///< position of the entry that leads by the other rows; -1: "nothing" leads
};

struct PredictiveGain {
  std::vector<BlockGain> blocks;
  double log_gain = 0.0, low = 0.0, high = 0.0;               ///< sum over blocks; 5 and 95 % quantiles of resampled blocks
  double reduction_pct = 0.0, low_pct = 0.0, high_pct = 0.0;  ///< of the RMS of standardised residuals
};

/// Leave-one-block-out gain of the odds against "nothing". For each block it is the ln odds from all rows minus the ln odds
/// without the rows of the block. The odds are those of all hypotheses, "nothing" included, against "nothing". `after` weighs
/// the entries by the other rows. With Q = Sigma^-1 and block b: e_b = (Q_bb)^-1 (Q r)_b has covariance (Q_bb)^-1; magnitudes
/// are weighted by the other rows, chi² - u_b' (Q_bb)^-1 u_b with u = Q (r - s). With fewer than three blocks the intervals
/// reach to zero, because so few blocks cannot decide.
/// @param blocks   rows of each; rows outside all blocks are always used
/// @param entries  their log_weight includes everything that does not depend on rows
[[nodiscard]] PredictiveGain gain_of_odds(const std::vector<std::vector<int>>& blocks, const Explanation& none,
                                          const std::vector<Explanation>& entries, int bootstrap, std::uint64_t seed);

/// ln (sum exp v) of at least one number.
[[nodiscard]] double log_sum(const std::vector<double>& v);

}  // namespace twindeck::diagnosis
