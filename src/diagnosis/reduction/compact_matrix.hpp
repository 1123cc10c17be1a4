#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <memory>
#include <vector>

namespace twindeck::diagnosis {

/// A symmetric matrix on the free dofs, both triangles; no entries where there is nothing.
using Symmetric = Eigen::SparseMatrix<double>;

/// Symmetric matrix stored as the block of its nonzero degrees of freedom. A location touches about a dozen. A sparse matrix
/// would list all columns, which for a thousand locations would fill the memory. Copies share the block.
class CompactMatrix {
 public:
  CompactMatrix() = default;
  CompactMatrix(const Symmetric& whole);  // NOLINT(google-explicit-constructor): the same matrix

  [[nodiscard]] Eigen::Index size() const { return size_; }  ///< n; 0 for an empty matrix
  [[nodiscard]] Eigen::Index nonZeros() const { return size_ > 0 ? block().nonZeros() : 0; }
  [[nodiscard]] const std::vector<int>& dofs() const { return content_->dofs; }        ///< that it touches
  [[nodiscard]] const Symmetric& block() const { return content_->block; }             ///< over them
  [[nodiscard]] Symmetric whole() const;                                               ///< (n × n)
  [[nodiscard]] Eigen::MatrixXd times(double factor, const Eigen::MatrixXd& x) const;  ///< factor S x (n × m)
  [[nodiscard]] Eigen::MatrixXd operator*(const Eigen::MatrixXd& x) const { return times(1.0, x); }

 private:
  struct Content {
    std::vector<int> dofs;
    Symmetric block;
  };
  Eigen::Index size_ = 0;
  std::shared_ptr<const Content> content_;
};

}  // namespace twindeck::diagnosis
