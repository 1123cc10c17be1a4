#include "linalg/symmetric_product.hpp"

#include "core/error.hpp"

namespace twindeck::linalg {

namespace {

using Eigen::Index;

/// Y += A X for `Width` vectors, whose entries of one degree of freedom lie side by side: xt, yt (Width × n).
template <int Width>
void multiply(const std::vector<int>& outer, const std::vector<int>& inner, const std::vector<double>& value, const double* xt,
              double* yt) {
  using Entries = Eigen::Matrix<double, Width, 1>;
  const auto at = [](auto* base, std::size_t dof) { return base + Width * dof; };
  for (std::size_t j = 0; j + 1 < outer.size(); ++j) {
    const Entries xj = Eigen::Map<const Entries>(at(xt, j));
    Entries sum = Entries::Zero();
    for (auto k = static_cast<std::size_t>(outer[j]); k < static_cast<std::size_t>(outer[j + 1]); ++k) {
      const auto i = static_cast<std::size_t>(inner[k]);
      sum += value[k] * Eigen::Map<const Entries>(at(xt, i));
      if (i != j) Eigen::Map<Entries>(at(yt, i)) += value[k] * xj;
    }
    Eigen::Map<Entries>(at(yt, j)) += sum;
  }
}

}  // namespace

SymmetricProduct::SymmetricProduct(const SparseMatrix& lower) {
  TWINDECK_ASSERT(lower.rows() == lower.cols());
  outer_.reserve(static_cast<std::size_t>(lower.outerSize()) + 1);
  outer_.push_back(0);
  for (Index j = 0; j < lower.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      if (it.value() == 0.0) continue;
      inner_.push_back(static_cast<int>(it.row()));
      value_.push_back(it.value());
    }
    outer_.push_back(static_cast<int>(inner_.size()));
  }
}

Eigen::MatrixXd SymmetricProduct::times(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  constexpr Index width = 4;
  const Index n = static_cast<Index>(outer_.size()) - 1;
  TWINDECK_ASSERT(x.rows() == n);
  Eigen::MatrixXd y(n, x.cols());
  Eigen::MatrixXd xt(width, n), yt(width, n);
  Index first = 0;
  for (; first + width <= x.cols(); first += width) {
    xt = x.middleCols(first, width).transpose();
    yt.setZero();
    multiply<width>(outer_, inner_, value_, xt.data(), yt.data());
    y.middleCols(first, width) = yt.transpose();
  }
  for (; first < x.cols(); ++first) {
    y.col(first).setZero();
    const Eigen::VectorXd one = x.col(first);
    multiply<1>(outer_, inner_, value_, one.data(), y.col(first).data());
  }
  return y;
}

std::vector<Index> SymmetricProduct::rows_in_use() const {
  std::vector<char> used(outer_.size() - 1, 0);
  for (std::size_t j = 0; j + 1 < outer_.size(); ++j) {
    for (auto k = static_cast<std::size_t>(outer_[j]); k < static_cast<std::size_t>(outer_[j + 1]); ++k) {
      used[j] = used[static_cast<std::size_t>(inner_[k])] = 1;
    }
  }
  std::vector<Index> rows;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) rows.push_back(static_cast<Index>(i));
  }
  return rows;
}

}  // namespace twindeck::linalg
