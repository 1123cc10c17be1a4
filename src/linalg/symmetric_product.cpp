#include "linalg/symmetric_product.hpp"

#include "core/error.hpp"

namespace twindeck::linalg {

using Eigen::Index;

SymmetricProduct::SymmetricProduct(const SparseMatrix& lower) : lower_(lower) {
  TWINDECK_ASSERT(lower.rows() == lower.cols());
  lower_.prune([](Index, Index, double value) { return value != 0.0; });
}

Eigen::MatrixXd SymmetricProduct::times(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  TWINDECK_ASSERT(x.rows() == size());
  return lower_.selfadjointView<Eigen::Lower>() * x;
}

std::vector<Index> SymmetricProduct::rows_in_use() const {
  std::vector<char> used(static_cast<std::size_t>(size()), 0);
  for (Index j = 0; j < lower_.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(lower_, j); it; ++it)
      used[static_cast<std::size_t>(j)] = used[static_cast<std::size_t>(it.row())] = 1;
  std::vector<Index> rows;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] != 0) rows.push_back(static_cast<Index>(i));
  return rows;
}

}  // namespace twindeck::linalg
