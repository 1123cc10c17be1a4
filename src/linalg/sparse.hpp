#pragma once

#include <Eigen/Sparse>

namespace twindeck::linalg {

/// Column-major sparse matrix with int indices (what CHOLMOD takes). A symmetric matrix holds both triangles unless its comment
/// says "lower triangle".
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// A X (n × m), four columns at a time; Eigen's own product reads A anew for each column. @param x (n × m)
[[nodiscard]] Eigen::MatrixXd product(const SparseMatrix& a, const Eigen::Ref<const Eigen::MatrixXd>& x);

/// The same of a symmetric matrix.  @param lower  lower triangle of A (n × n)
[[nodiscard]] Eigen::MatrixXd symmetric_product(const SparseMatrix& lower, const Eigen::Ref<const Eigen::MatrixXd>& x);

/// The matrix without stored zeros, for repeated products. Stiffness and mass share one pattern, where most entries of the mass
/// are zero.
[[nodiscard]] inline SparseMatrix without_zeros(SparseMatrix matrix) {
  matrix.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  return matrix;
}

}  // namespace twindeck::linalg
