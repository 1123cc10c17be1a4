#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// Misfit of a block. A block is either the rows of one condition, mode, channel or type, compared with their prediction from
/// all other rows, or the slopes of all modes against temperature, amplitude, wind or people.
struct BlockMisfit {
  std::string name;  ///< "frequency_Hz in frost", "shape of mode 3", "channel M4z", "frequency_Hz against temperature"
  int rows = 0;
  double statistic = 0.0;  ///< chi² of `dof` degrees of freedom if nothing is missing
  int dof = 0;
  double p_value = 1.0;
};

/// The misfit that remains after bounds, element scatter, model errors and named causes.
struct ResidualTest {
  double statistic = 0.0;  ///< of all training rows
  int dof = 0;
  double p_value = 1.0;
  std::vector<BlockMisfit> blocks;  ///< the least likely first
  double block_p_value = 1.0;       ///< p-value of the least likely block, times the number of blocks (Bonferroni)

  /// Replaces the chi² of all rows by that of another law.
  void take_total(double chi_squared, long degrees);
};

/// Two tests of a fit. The sum over all rows detects a misfit that is spread over many rows. The test of the blocks detects a
/// misfit in a few rows, which the sum over all rows hides. It compares the rows of each block with their prediction from all
/// other rows. With r = y - g + J x ~ N(0, S) and u = S^-1 r, the block b given the other rows has the statistic
/// u_b' ((S^-1)_bb)^-1 u_b (conditional normal distribution; Cook and Weisberg 1982, section 3.5, for the deletion of several
/// rows).
/// Slopes are tested in the same way. Each column of D belongs to one mode. It is a straight line through the rows of the mode,
/// as a function of a variable that differs between conditions. The score D'u has the variance D' S^-1 D (Rao 1948). The test
/// of the slopes detects a wrong cause that follows the mean trend of all modes but not the trend of each mode.
[[nodiscard]] ResidualTest residual_test(const Inference& inference, const Fit& fit);

}  // namespace twindeck::diagnosis
