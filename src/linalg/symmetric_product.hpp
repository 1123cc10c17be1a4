#pragma once

#include <Eigen/Core>
#include <vector>

#include "linalg/types.hpp"

namespace twindeck::linalg {

/// A symmetric sparse matrix made ready for products with blocks of vectors: stored zeros are left out. On the common pattern
/// of stiffness and mass most of the mass is zeros.
class SymmetricProduct {
 public:
  /// @param lower  lower triangle (n × n)
  explicit SymmetricProduct(const SparseMatrix& lower);
  /// A X.  @param x (n × m) @return (n × m)
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  [[nodiscard]] Eigen::Index size() const { return lower_.rows(); }
  /// Rows with an entry other than zero.
  [[nodiscard]] std::vector<Eigen::Index> rows_in_use() const;

 private:
  SparseMatrix lower_;
};

}  // namespace twindeck::linalg
