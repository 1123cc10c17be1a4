#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace twindeck::sensitivity {

/// Result of the selection for one parameter.
struct SelectedParameter {
  double score = 0.0;      ///< [-] change of the compared frequencies over its half range, in their standard deviations
  double remaining = 0.0;  ///< [-] part of the score that the parameters kept before it cannot reproduce
  int rank = 0;            ///< order in which it was examined, from 1
  bool selected = false;
  std::string reason;
};

/// Selects the parameters worth updating:
///
///   A_ij = (d ln f_i / d ln p_j) · (half range of p_j / p_j) / sigma_i,
///
/// the shift of frequency i, in its standard deviations, over half the allowed range of parameter j. The part of a column that
/// the kept parameters cannot reproduce is what remains of it (QR with column pivoting). Parameters are examined by the largest
/// remainder first. One is kept if its remainder is at least `threshold`. With 1 it can still move the compared frequencies,
/// jointly, by one standard deviation. A parameter is refused if its effect is too small, or if other parameters have the same
/// effect; `reason` says which.
/// @param scaled A (n_compared × n_parameters) @param names (n_parameters)
[[nodiscard]] std::vector<SelectedParameter> select_parameters(const Eigen::MatrixXd& scaled,
                                                               const std::vector<std::string>& names, double threshold);

/// What the compared frequencies say about the parameters within their ranges.
struct Identifiability {
  Eigen::VectorXd singular_values;  ///< (n_parameters) of A, descending; zero beyond the number of frequencies
  int retained = 0;                 ///< number of directions with a singular value of at least the cutoff
  Eigen::VectorXd resolution;       ///< (n_parameters) diagonal of V_r V_r': 1 = seen alone, 0 = not seen
};

/// Truncated singular value decomposition A = U S V'. A direction counts as identifiable if half its range moves the
/// frequencies by at least `cutoff` standard deviations. Reference: Menke (2012), Geophysical Data Analysis, section 4.3 (model
/// resolution).
[[nodiscard]] Identifiability identifiability(const Eigen::MatrixXd& scaled, double cutoff);

}  // namespace twindeck::sensitivity
