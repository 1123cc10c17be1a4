#pragma once

#include <Eigen/Core>
#include <vector>

#include "linalg/types.hpp"

namespace twindeck::linalg {

/// A symmetric sparse matrix for products with blocks of vectors, without stored zeros. On the common pattern of stiffness and
/// mass most entries of the mass are zero.
class SymmetricProduct {
 public:
  /// @param lower  lower triangle (n × n)
  explicit SymmetricProduct(const SparseMatrix& lower);
  /// A X.  @param x (n × m) @return (n × m)
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  [[nodiscard]] Eigen::Index size() const { return lower_.rows(); }
  /// Rows with a nonzero entry.
  [[nodiscard]] std::vector<Eigen::Index> rows_in_use() const;

 private:
  SparseMatrix lower_;
};

}  // namespace twindeck::linalg
