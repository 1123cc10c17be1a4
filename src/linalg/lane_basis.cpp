#include "linalg/lane_basis.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "linalg/lane_kernels.hpp"

namespace twindeck::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Square = Eigen::Matrix<double, 8, 8>;

/// Rows of a pass: the entries of eight vectors in so many rows stay in the nearest cache while the blocks of a basis go by.
constexpr Index kRows = 256;

/// Calls `work(first row, rows)` for each pass.
template <typename Work>
void in_passes(Index rows, const Work& work) {
  for (Index row = 0; row < rows; row += kRows) work(row, std::min(kRows, rows - row));
}

}  // namespace

LaneBasis::LaneBasis(const Eigen::Ref<const MatrixXd>& columns) : rows_(columns.rows()) {
  for (Index first = 0; first < columns.cols(); first += 8) {
    const Index count = std::min<Index>(8, columns.cols() - first);
    Lanes lanes(8, rows_);
    lanes.topRows(count) = columns.middleCols(first, count).transpose();
    lanes.bottomRows(8 - count).setZero();
    append(std::move(lanes), count);
  }
}

MatrixXd LaneBasis::dense() const {
  MatrixXd out(rows_, size_);
  for (const Block& block : blocks_)
    out.middleCols(block.first, block.columns) = block.lanes.topRows(block.columns).transpose();
  return out;
}

void LaneBasis::append(Lanes lanes, Index columns) {
  TWINDECK_ASSERT(lanes.cols() == rows_ && columns > 0 && columns <= 8);
  blocks_.push_back({std::move(lanes), size_, columns});
  size_ += columns;
}

void LaneBasis::append(LaneBasis more) {
  for (Block& block : more.blocks_) append(std::move(block.lanes), block.columns);
}

void LaneBasis::append(const Eigen::VectorXd& column) {
  TWINDECK_ASSERT(column.size() == rows_);
  if (blocks_.empty() || blocks_.back().columns == 8) blocks_.push_back({Lanes::Zero(8, rows_), size_, 0});
  blocks_.back().lanes.row(blocks_.back().columns++) = column.transpose();
  ++size_;
}

void LaneBasis::append_product(const LaneBasis& w, const MatrixXd& c) {
  TWINDECK_ASSERT(w.rows_ == rows_ && c.rows() == w.size_);
  const std::size_t before = blocks_.size();
  for (Index first = 0; first < c.cols(); first += 8) append(Lanes::Zero(8, rows_), std::min<Index>(8, c.cols() - first));
  add_product(before, w, c);
}

void LaneBasis::subtract_product(const LaneBasis& w, const MatrixXd& c) {
  TWINDECK_ASSERT(w.rows_ == rows_ && c.rows() == w.size_ && c.cols() == size_);
  add_product(0, w, -c);
}

MatrixXd LaneBasis::transposed_times(const LaneBasis& x) const {
  TWINDECK_ASSERT(x.rows_ == rows_);
  const std::size_t wide = x.blocks_.size();
  std::vector<Square> sums(blocks_.size() * wide, Square::Zero());
  in_passes(rows_, [&](Index row, Index count) {
    for (std::size_t i = 0; i < blocks_.size(); ++i)
      for (std::size_t j = 0; j < wide; ++j)
        lane_kernels().inner_8(blocks_[i].lanes.data() + 8 * row, x.blocks_[j].lanes.data() + 8 * row, count,
                               sums[i * wide + j].data());
  });
  MatrixXd out(size_, x.size_);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    for (std::size_t j = 0; j < wide; ++j) {
      const Block &left = blocks_[i], &right = x.blocks_[j];
      out.block(left.first, right.first, left.columns, right.columns) =
          sums[i * wide + j].topLeftCorner(left.columns, right.columns);
    }
  }
  return out;
}

void LaneBasis::add_product(std::size_t first, const LaneBasis& w, const MatrixXd& c) {
  const std::size_t wide = blocks_.size() - first;
  std::vector<Square> parts(w.blocks_.size() * wide, Square::Zero());
  for (std::size_t i = 0; i < w.blocks_.size(); ++i) {
    for (std::size_t j = 0; j < wide; ++j) {
      const Block &from = w.blocks_[i], &to = blocks_[first + j];
      parts[i * wide + j].topLeftCorner(to.columns, from.columns) =
          c.block(from.first, to.first - blocks_[first].first, from.columns, to.columns).transpose();
    }
  }
  in_passes(rows_, [&](Index row, Index count) {
    for (std::size_t i = 0; i < w.blocks_.size(); ++i)
      for (std::size_t j = 0; j < wide; ++j)
        lane_kernels().combine_8(parts[i * wide + j].data(), w.blocks_[i].lanes.data() + 8 * row, count,
                                 blocks_[first + j].lanes.data() + 8 * row);
  });
}

}  // namespace twindeck::linalg
