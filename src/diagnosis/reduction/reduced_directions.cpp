#include "diagnosis/reduction/reduced_directions.hpp"

#include <utility>

namespace twindeck::diagnosis {

using Eigen::Index;

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
