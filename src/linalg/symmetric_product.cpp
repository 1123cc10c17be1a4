#include "linalg/symmetric_product.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "linalg/lane_kernels.hpp"

namespace twindeck::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Four columns in one pass over the entries. In plain instructions, since another order of these sums is another realisation
/// of a virtual campaign (decision 0011).
MatrixXd times(const LowerTriangle& a, const Eigen::Ref<const MatrixXd>& x) {
  constexpr Index width = 4;
  static const SymmetricMultiply multiply = plain_kernels().multiply_4;
  TWINDECK_ASSERT(x.rows() == a.size);
  MatrixXd y(a.size, x.cols()), xt = MatrixXd::Zero(width, a.size), yt(width, a.size);
  for (Index first = 0; first < x.cols(); first += width) {
    const Index count = std::min(width, x.cols() - first);
    xt.topRows(count) = x.middleCols(first, count).transpose();
    yt.setZero();
    multiply(a, xt.data(), yt.data());
    y.middleCols(first, count) = yt.topRows(count).transpose();
  }
  return y;
}

LaneBasis times(const LowerTriangle& a, const LaneBasis& x) {
  TWINDECK_ASSERT(x.rows() == a.size);
  LaneBasis y(a.size);
  for (const LaneBasis::Block& block : x.blocks()) {
    Lanes image = Lanes::Zero(8, a.size);
    lane_kernels().multiply_8(a, block.lanes.data(), image.data());
    y.append(std::move(image), block.columns);
  }
  return y;
}

}  // namespace

SymmetricProduct::SymmetricProduct(const SparseMatrix& lower) {
  TWINDECK_ASSERT(lower.rows() == lower.cols());
  outer_.reserve(static_cast<std::size_t>(lower.outerSize()) + 1);
  outer_.push_back(0);
  const auto used = static_cast<std::size_t>((lower.coeffs() != 0.0).count());
  inner_.reserve(used);
  value_.reserve(used);
  for (Index j = 0; j < lower.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      if (it.value() == 0.0) continue;
      inner_.push_back(static_cast<int>(it.row()));
      value_.push_back(it.value());
    }
    outer_.push_back(static_cast<int>(inner_.size()));
  }
}

LowerTriangle SymmetricProduct::triangle() const { return {size(), outer_.data(), inner_.data(), value_.data()}; }

Eigen::MatrixXd SymmetricProduct::times(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  return linalg::times(triangle(), x);
}

LaneBasis SymmetricProduct::times(const LaneBasis& x) const { return linalg::times(triangle(), x); }

LaneBasis symmetric_product(const SparseMatrix& lower, const LaneBasis& x) {
  TWINDECK_ASSERT(lower.rows() == lower.cols() && lower.isCompressed());
  return times({lower.rows(), lower.outerIndexPtr(), lower.innerIndexPtr(), lower.valuePtr()}, x);
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
