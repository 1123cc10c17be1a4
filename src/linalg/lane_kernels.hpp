#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace twindeck::linalg {

/// A factor L (n × n, lower) whose neighbouring columns with the same pattern below them are stored together as dense blocks
/// ("supernodes"), as CHOLMOD leaves it. Block s holds columns first_column[s] … first_column[s + 1] - 1 in the rows
/// row[row_start[s]] … row[row_start[s + 1] - 1], ascending, of which the first are those of its own columns; its values lie
/// column after column from value[value_start[s]].
struct SupernodalFactor {
  std::size_t n = 0, blocks = 0;
  const int *first_column = nullptr, *row_start = nullptr, *value_start = nullptr, *row = nullptr;
  const double* value = nullptr;
};

/// Solves L Lᵀ X = B in place for `Width` vectors, whose entries of one row lie side by side: y (Width × n).
///
/// CHOLMOD calls the BLAS for each block, thousands of times on blocks of some fifteen columns, and gathers and scatters
/// between the calls. Here the entries of a few rows of all vectors stay in registers while a block passes by, and the vectors
/// fill the machine's lanes whatever a block's size: twice as fast at four and eight vectors. Most of the time goes into
/// reading the factor, so the more vectors at once the better. The sums run in one fixed order for each vector, so that a
/// vector's solution does not depend on how many others are solved beside it.
using SupernodalSweep = void (*)(const SupernodalFactor& factor, double* y);

/// A symmetric sparse matrix (size × size) by its lower triangle, column after column.
struct LowerTriangle {
  Eigen::Index size = 0;
  const int *outer = nullptr, *inner = nullptr;
  const double* value = nullptr;
};

/// y += A x for `Width` vectors, whose entries of one row lie side by side: x, y (Width × n).
using SymmetricMultiply = void (*)(const LowerTriangle& a, const double* x, double* y);

/// c += A Bᵀ: the inner products of vectors side by side, a, b (Width × n), c (Width × Width).
using LaneInner = void (*)(const double* a, const double* b, long n, double* c);

/// y += C x: combinations of vectors side by side, x, y (Width × n), c (Width × Width).
using LaneCombine = void (*)(const double* c, const double* x, long n, double* y);

/// What works on several vectors side by side, one in each lane of the machine's registers, by the number of vectors.
struct LaneKernels {
  SupernodalSweep sweep_4, sweep_8, sweep_16;
  SymmetricMultiply multiply_4, multiply_8;
  LaneInner inner_8;
  LaneCombine combine_8;
};
/// In the instructions of this machine.
[[nodiscard]] const LaneKernels& lane_kernels();

// The same for one instruction set each; call them through `lane_kernels`, which knows what the machine has.
[[nodiscard]] LaneKernels plain_kernels();
[[nodiscard]] LaneKernels avx2_kernels();
[[nodiscard]] LaneKernels avx512_kernels();

}  // namespace twindeck::linalg
