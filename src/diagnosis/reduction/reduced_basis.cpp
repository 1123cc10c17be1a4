#include "diagnosis/reduction/reduced_basis.hpp"

#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;

ReducedBasis::ReducedBasis(MatrixXd common)
    : common_vectors_(std::move(common)),
      common_rows_(common_vectors_.transpose()),
      group_of_(static_cast<std::size_t>(common_vectors_.cols()), -1) {}

std::pair<int, Index> ReducedBasis::place_of(int column) const {
  const int group = group_of_[static_cast<std::size_t>(column)];
  return {group, column - groups_[static_cast<std::size_t>(group)].first};
}

std::vector<std::vector<int>> ReducedBasis::append(const std::vector<Block>& blocks) {
  std::vector<std::vector<int>> columns(blocks.size());
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Index count = blocks[i].vectors->cols(), next = size();
    if (count == 0) continue;
    const auto group = static_cast<int>(groups_.size());
    groups_.push_back({next, count});
    for (Index k = 0; k < count; ++k) columns[i].push_back(static_cast<int>(next + k));
    group_of_.insert(group_of_.end(), static_cast<std::size_t>(count), group);
    again_.push_back(blocks[i].again);
    kept_.emplace_back();
    keep(group, blocks[i].vectors);
  }
  return columns;
}

void ReducedBasis::keep(int group, std::shared_ptr<const MatrixXd> vectors) const {
  kept_[static_cast<std::size_t>(group)] = std::move(vectors);
  order_.push_back(group);
  if (order_.size() <= kKept) return;
  kept_[static_cast<std::size_t>(order_.front())] = nullptr;
  order_.pop_front();
}

std::shared_ptr<const MatrixXd> ReducedBasis::vectors(int group) const {
  const auto at = static_cast<std::size_t>(group);
  {
    const std::scoped_lock lock(mutex_);
    if (kept_[at] != nullptr) return kept_[at];
  }
  auto found = std::make_shared<const MatrixXd>(again_[at]());
  const std::scoped_lock lock(mutex_);
  if (kept_[at] == nullptr) keep(group, found);
  return found;
}

MatrixXd ReducedBasis::own(const std::vector<int>& columns) const {
  const auto c = static_cast<std::size_t>(common());
  MatrixXd out(common_vectors_.rows(), std::ssize(columns) - common());
  std::shared_ptr<const MatrixXd> here;
  int known = -1;
  for (std::size_t k = c; k < columns.size(); ++k) {
    const auto [group, at] = place_of(columns[k]);
    if (group != known) here = vectors(group);
    known = group;
    out.col(static_cast<Index>(k - c)) = here->col(at);
  }
  return out;
}

MatrixXd ReducedBasis::motion(const MatrixXd& own, const MatrixXd& x) const {
  MatrixXd out = linalg::product(common_vectors_, x.topRows(common()));
  for (Index k = 0; k < own.cols(); ++k) out += own.col(k) * x.row(common() + k);
  return out;
}

MatrixXd ReducedBasis::projected(const MatrixXd& own, const MatrixXd& force) const {
  MatrixXd out(common() + own.cols(), force.cols());
  out.topRows(common()) = linalg::product(common_rows_, force);
  for (Index k = 0; k < own.cols(); ++k) out.row(common() + k) = own.col(k).transpose() * force;
  return out;
}

ReducedDirections::ReducedDirections(Eigen::SparseMatrix<double> b, std::shared_ptr<const ReducedBasis> basis, bool for_all)
    : b_(std::move(b)), basis_(std::move(basis)), common_(basis_->common_vectors().transpose() * b_), for_all_(for_all) {}

Eigen::VectorXd ReducedDirections::part(Index d, const std::vector<int>& columns) const {
  Eigen::VectorXd out(std::ssize(columns));
  const Index c = basis_->common();
  out.head(c) = common_.col(d);
  Eigen::MatrixXd other;
  int known = -1;
  for (Index k = c; k < out.size(); ++k) {
    const auto [group, i] = basis_->place_of(columns[static_cast<std::size_t>(k)]);
    const int kept = group - first_;
    if (kept >= 0 && kept < std::ssize(kept_)) {
      out[k] = kept_[static_cast<std::size_t>(kept)](i, d);
      continue;
    }
    if (group != known) other = at(group);
    known = group;
    out[k] = other(i, d);
  }
  return out;
}

void ReducedDirections::keep(int group) {
  if (cols() == 0 || for_all_) return;
  first_ = group;
  kept_ = {at(group)};
}

void ReducedDirections::follow_basis() {
  if (!for_all_) return;
  for (int group = static_cast<int>(kept_.size()); group < std::ssize(basis_->groups()); ++group) kept_.push_back(at(group));
}

}  // namespace twindeck::diagnosis
