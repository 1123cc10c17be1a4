#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// Misfit of a block of rows (one condition, mode, channel or type) against its prediction from all other rows, or of its
/// slopes against temperature, amplitude, wind or people.
struct BlockMisfit {
  std::string name;  ///< "frequency_Hz in frost", "shape of mode 3", "channel M4z", "frequency_Hz against temperature"
  int rows = 0;
  double statistic = 0.0;  ///< chi² of `dof` degrees of freedom if nothing is missing
  int dof = 0;
  double p_value = 1.0;
};

/// Whether a misfit is left that bounds, element scatter and the named causes do not explain.
struct ResidualTest {
  double statistic = 0.0;  ///< of all training rows
  int dof = 0;
  double p_value = 1.0;
  std::vector<BlockMisfit> blocks;  ///< the least likely first
  double block_p_value = 1.0;       ///< of the least likely block, times their number (Bonferroni)

  [[nodiscard]] bool rejects(double alpha) const { return p_value < alpha || block_p_value < alpha; }
};

/// Two tests of a fit, each at its level. The sum over all rows detects a misfit that is spread. The rows of each block against
/// their prediction by all others detect a misfit in a few rows, which is lost in the sum. With r = y - g + J x ~ N(0, S) and
/// u = S^-1 r, the block b given the rest has the statistic u_b' ((S^-1)_bb)^-1 u_b (conditional normal law; Cook and Weisberg
/// 1982, section 3.5, for the deletion of several rows). Slopes D (a column a mode: a line through its rows, in what varies
/// between conditions) are tested in the same way, by the score D'u of variance D' S^-1 D (Rao 1948): they detect a
/// wrong cause that follows the mean trend of all modes but not the trend of each mode.
[[nodiscard]] ResidualTest residual_test(const Inference& inference, const Fit& fit);

}  // namespace twindeck::diagnosis
