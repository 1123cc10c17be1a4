#include "diagnosis/reduction/reduced_matrix.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kAtOnce = 256;  ///< columns of V that are projected together: their images are n × 256

}  // namespace

ReducedBasis::ReducedBasis(MatrixXd common)
    : vectors(std::move(common)), common_rows(vectors.transpose()), group_of(static_cast<std::size_t>(vectors.cols()), -1) {}

std::vector<std::vector<int>> ReducedBasis::append(const std::vector<MatrixXd>& blocks) {
  Index next = size(), total = next;
  for (const MatrixXd& block : blocks) total += block.cols();
  vectors.conservativeResize(Eigen::NoChange, total);
  std::vector<std::vector<int>> columns(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Index count = blocks[i].cols();
    if (count == 0) continue;
    vectors.middleCols(next, count) = blocks[i];
    groups.push_back({next, count});
    for (Index k = 0; k < count; ++k) columns[i].push_back(static_cast<int>(next + k));
    group_of.insert(group_of.end(), static_cast<std::size_t>(count), static_cast<int>(groups.size()) - 1);
    next += count;
  }
  return columns;
}

MatrixXd ReducedBasis::own(const std::vector<int>& columns) const {
  const auto c = static_cast<std::size_t>(common());
  MatrixXd out(vectors.rows(), std::ssize(columns) - common());
  for (std::size_t k = c; k < columns.size(); ++k) out.col(static_cast<Index>(k - c)) = vectors.col(columns[k]);
  return out;
}

MatrixXd ReducedBasis::motion(const std::vector<int>& columns, const MatrixXd& x) const {
  MatrixXd out = linalg::product(vectors.leftCols(common()), x.topRows(common()));
  for (Index k = common(); k < std::ssize(columns); ++k) out += vectors.col(columns[static_cast<std::size_t>(k)]) * x.row(k);
  return out;
}

MatrixXd ReducedBasis::projected(const std::vector<int>& columns, const MatrixXd& force) const {
  MatrixXd out(std::ssize(columns), force.cols());
  for (Index k = 0; k < force.cols(); ++k) out.col(k).head(common()).noalias() = common_rows * force.col(k);  // few columns
  for (Index k = common(); k < std::ssize(columns); ++k)
    out.row(k) = vectors.col(columns[static_cast<std::size_t>(k)]).transpose() * force;
  return out;
}

ReducedMatrix::ReducedMatrix(const Symmetric& s, std::shared_ptr<const ReducedBasis> basis, bool for_all)
    : basis_(std::move(basis)), for_all_(for_all), known_(std::make_shared<Known>()) {
  std::vector<int> compact_of(static_cast<std::size_t>(s.cols()), -1);
  for (int c = 0; c < s.outerSize(); ++c)
    if (Symmetric::InnerIterator(s, c)) {
      compact_of[static_cast<std::size_t>(c)] = static_cast<int>(dofs_.size());
      dofs_.push_back(c);
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (const int c : dofs_)
    for (Symmetric::InnerIterator e(s, c); e; ++e)
      entries.emplace_back(compact_of[static_cast<std::size_t>(e.row())], compact_of[static_cast<std::size_t>(c)], e.value());
  compact_.resize(std::ssize(dofs_), std::ssize(dofs_));
  compact_.setFromTriplets(entries.begin(), entries.end());
  local_ = std::ssize(dofs_) <= basis_->common();
  MatrixXd shared = basis_->common_rows(Eigen::all, dofs_);
  const MatrixXd image = compact_ * shared.transpose();
  common_ = linalg::product(shared, image);
  common_.triangularView<Eigen::StrictlyLower>() = common_.transpose();
  if (local_) common_at_dofs_ = std::move(shared);
  follow_basis();
}

void ReducedMatrix::follow_basis() {
  if (local_ || !for_all_ || basis_ == nullptr) return;
  const std::vector<ReducedBasis::Group>& groups = basis_->groups;
  const Index c = basis_->common();
  const MatrixXd common_here = basis_->common_rows(Eigen::all, dofs_);
  while (all_.size() < groups.size()) {
    const std::size_t begin = all_.size();
    std::size_t end = begin + 1;
    const auto columns_to = [&](std::size_t g) { return groups[g - 1].first + groups[g - 1].count - groups[begin].first; };
    while (end < groups.size() && columns_to(end + 1) <= kAtOnce) ++end;
    const MatrixXd here = at_dofs(groups[begin].first, columns_to(end)), image = compact_ * here;
    const MatrixXd shared = linalg::product(common_here, image);
    for (std::size_t g = begin; g < end; ++g) {
      const Index at = groups[g].first - groups[begin].first, count = groups[g].count;
      MatrixXd& out = all_.emplace_back(c + count, count);
      out.topRows(c) = shared.middleCols(at, count);
      out.bottomRows(count) = here.middleCols(at, count).transpose() * image.middleCols(at, count);
    }
  }
}

MatrixXd ReducedMatrix::at_dofs(Index first, Index count) const {
  MatrixXd out(std::ssize(dofs_), count);
  for (Index k = 0; k < count; ++k) {
    const auto v = basis_->vectors.col(first + k);
    for (Index i = 0; i < out.rows(); ++i) out(i, k) = v[dofs_[static_cast<std::size_t>(i)]];
  }
  return out;
}

const MatrixXd& ReducedMatrix::own(int group) const {
  if (for_all_ && !local_) return all_[static_cast<std::size_t>(group)];
  const std::scoped_lock lock(known_->mutex);
  const auto [at, is_new] = known_->own.try_emplace(group);
  if (!is_new) return at->second;
  const ReducedBasis::Group& g = basis_->groups[static_cast<std::size_t>(group)];
  const MatrixXd here = at_dofs(g.first, g.count), image = compact_ * here;
  at->second.resize(basis_->common() + g.count, g.count);
  at->second << linalg::product(basis_->common_rows(Eigen::all, dofs_), image), here.transpose() * image;
  return at->second;
}

const MatrixXd& ReducedMatrix::cross(int low, int high) const {
  const std::scoped_lock lock(known_->mutex);
  const auto [at, is_new] = known_->cross.try_emplace({low, high});
  if (!is_new) return at->second;
  const ReducedBasis::Group &a = basis_->groups[static_cast<std::size_t>(low)],
                            &b = basis_->groups[static_cast<std::size_t>(high)];
  const MatrixXd image = compact_ * at_dofs(b.first, b.count);
  at->second = at_dofs(a.first, a.count).transpose() * image;
  return at->second;
}

double ReducedMatrix::entry(int row, int column) const {
  const int a = basis_->group_of[static_cast<std::size_t>(row)], b = basis_->group_of[static_cast<std::size_t>(column)];
  const Index i = row - basis_->groups[static_cast<std::size_t>(a)].first,
              j = column - basis_->groups[static_cast<std::size_t>(b)].first;
  if (a == b) return own(a)(basis_->common() + i, j);
  return a < b ? cross(a, b)(i, j) : cross(b, a)(j, i);
}

void ReducedMatrix::add_own(double amount, const std::vector<int>& columns, Eigen::Ref<MatrixXd> total) const {
  const Index c = basis_->common(), n = std::ssize(columns);
  TWINDECK_ASSERT(n >= c && (c == 0 || columns[static_cast<std::size_t>(c) - 1] == c - 1));
  if (n == c) return;
  if (local_) {  // few degrees of freedom, so that nothing is kept
    MatrixXd here(std::ssize(dofs_), n - c);
    for (Index k = c; k < n; ++k) here.col(k - c) = at_dofs(columns[static_cast<std::size_t>(k)], 1);
    const MatrixXd image = amount * (compact_ * here);
    total.topRows(c).noalias() += common_at_dofs_ * image;
    total.bottomRows(n - c).noalias() += here.transpose() * image;
    return;
  }
  for (Index k = c; k < n; ++k) {
    const int column = columns[static_cast<std::size_t>(k)], group = basis_->group_of[static_cast<std::size_t>(column)];
    const Index at = column - basis_->groups[static_cast<std::size_t>(group)].first;
    total.col(k - c).head(c) += amount * own(group).col(at).head(c);
    for (Index i = c; i < n; ++i) total(i, k - c) += amount * entry(columns[static_cast<std::size_t>(i)], column);
  }
}

MatrixXd ReducedMatrix::part(const std::vector<int>& columns) const {
  const Index c = basis_->common(), n = std::ssize(columns);
  MatrixXd total = MatrixXd::Zero(n, n);
  total.topLeftCorner(c, c) = common_;
  add_own(1.0, columns, total.rightCols(n - c));
  total.bottomLeftCorner(n - c, c) = total.topRightCorner(c, n - c).transpose();
  return total;
}

void ReducedMatrix::add_image(double amount, const MatrixXd& motion, MatrixXd& force) const {
  for (Index k = 0; k < motion.cols(); ++k)
    for (int j = 0; j < compact_.outerSize(); ++j) {
      const double u = amount * motion(dofs_[static_cast<std::size_t>(j)], k);
      for (Symmetric::InnerIterator e(compact_, j); e; ++e) force(dofs_[static_cast<std::size_t>(e.row())], k) += e.value() * u;
    }
}

void ReducedMatrix::add_product(double amount, const std::vector<int>& columns, const VectorXd& motion,
                                Eigen::Ref<VectorXd> sum) const {
  const VectorXd image = amount * (compact_ * VectorXd(motion(dofs_)));
  const Index c = basis_->common();
  sum.head(c).noalias() += common_at_dofs_ * image;
  for (Index k = c; k < std::ssize(columns); ++k)
    sum[k] += basis_->vectors.col(columns[static_cast<std::size_t>(k)])(dofs_).dot(image);
}

}  // namespace twindeck::diagnosis
