#pragma once

#include <Eigen/Core>
#include <vector>

#include "linalg/lane_basis.hpp"
#include "linalg/lane_kernels.hpp"
#include "linalg/types.hpp"

namespace twindeck::linalg {

/// A symmetric sparse matrix made ready for products with blocks of vectors: stored zeros are left out (on the common pattern
/// of stiffness and mass most of the mass is zeros), and four vectors are multiplied in one pass over the entries.
class SymmetricProduct {
 public:
  /// @param lower  lower triangle (n × n)
  explicit SymmetricProduct(const SparseMatrix& lower);
  /// A X.  @param x (n × m) @return (n × m)
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  [[nodiscard]] LaneBasis times(const LaneBasis& x) const;
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(outer_.size()) - 1; }
  /// Rows with an entry other than zero.
  [[nodiscard]] std::vector<Eigen::Index> rows_in_use() const;

 private:
  [[nodiscard]] LowerTriangle triangle() const;

  std::vector<int> outer_, inner_;
  std::vector<double> value_;
};

/// A X of a matrix without stored zeros. @param lower  lower triangle (n × n) @param x (n × m)
[[nodiscard]] LaneBasis symmetric_product(const SparseMatrix& lower, const LaneBasis& x);

}  // namespace twindeck::linalg
