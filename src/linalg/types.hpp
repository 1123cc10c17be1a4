#pragma once

#include <Eigen/Sparse>

#include "core/error.hpp"

namespace twindeck::linalg {

/// Column-major sparse matrix with int indices (what CHOLMOD takes). A symmetric matrix holds both triangles unless its comment
/// says "lower triangle".
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// A symmetric sparse matrix for products with blocks of vectors, without stored zeros. On the common pattern of stiffness and
/// mass most entries of the mass are zero.
class SymmetricProduct {
 public:
  /// @param lower  lower triangle (n × n)
  explicit SymmetricProduct(const SparseMatrix& lower) : lower_(lower) {
    TWINDECK_ASSERT(lower.rows() == lower.cols());
    lower_.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  }
  /// A X.  @param x (n × m) @return (n × m)
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
    TWINDECK_ASSERT(x.rows() == size());
    return lower_.selfadjointView<Eigen::Lower>() * x;
  }
  [[nodiscard]] Eigen::Index size() const { return lower_.rows(); }

 private:
  SparseMatrix lower_;
};

}  // namespace twindeck::linalg
