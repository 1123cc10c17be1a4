#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace twindeck::sensitivity {

/// One parameter's fate in the selection.
struct SelectedParameter {
  double score = 0.0;      ///< how far its allowed range moves the compared frequencies, in their standard deviations
  double remaining = 0.0;  ///< what is left of the score when what the parameters kept before it can do is taken out
  int rank = 0;            ///< order in which it was looked at, from 1
  bool selected = false;
  std::string reason;
};

/// Selects the parameters worth updating, by one rule laid down before any result was seen:
///
///   A_ij = (d ln f_i / d ln p_j) · (half range of p_j / p_j) / sigma_i,
///
/// the shift of frequency i, in its standard deviations, over half the allowed range of parameter j. Parameters are taken in
/// the order of the largest part of their column that those kept before cannot reproduce (QR with column pivoting); one is kept
/// while that part is at least `threshold` (1: it can still move the compared frequencies, jointly, by one standard deviation
/// in a way of its own). So a parameter falls out for two reasons, each named: it does too little, or others do the same.
/// @param scaled A (n_compared × n_parameters) @param names (n_parameters)
[[nodiscard]] std::vector<SelectedParameter> select_parameters(const Eigen::MatrixXd& scaled,
                                                               const std::vector<std::string>& names, double threshold);

/// What the compared frequencies say about the parameters within their ranges.
struct Identifiability {
  Eigen::VectorXd singular_values;  ///< (n_parameters) of A, descending; zero beyond the number of frequencies
  int retained = 0;                 ///< directions with a singular value of at least the cutoff
  Eigen::VectorXd resolution;       ///< (n_parameters) diagonal of V_r V_r': 1 = seen alone, 0 = not seen
};

/// Truncated singular value decomposition A = U S V'. A direction counts as identifiable if half its range moves the
/// frequencies by at least `cutoff` standard deviations. Reference: Menke (2012), Geophysical Data Analysis, section 4.3 (model
/// resolution).
[[nodiscard]] Identifiability identifiability(const Eigen::MatrixXd& scaled, double cutoff);

}  // namespace twindeck::sensitivity
