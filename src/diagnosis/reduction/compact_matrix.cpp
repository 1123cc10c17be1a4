#include "diagnosis/reduction/compact_matrix.hpp"

namespace twindeck::diagnosis {

using Triplets = std::vector<Eigen::Triplet<double>>;

CompactMatrix::CompactMatrix(const Symmetric& whole) : size_(whole.cols()) {
  auto content = std::make_shared<Content>();
  std::vector<int> compact_of(static_cast<std::size_t>(whole.cols()), -1);
  for (int c = 0; c < whole.outerSize(); ++c)
    if (Symmetric::InnerIterator(whole, c)) {
      compact_of[static_cast<std::size_t>(c)] = static_cast<int>(content->dofs.size());
      content->dofs.push_back(c);
    }
  Triplets entries;
  for (const int c : content->dofs)
    for (Symmetric::InnerIterator e(whole, c); e; ++e)
      entries.emplace_back(compact_of[static_cast<std::size_t>(e.row())], compact_of[static_cast<std::size_t>(c)], e.value());
  content->block.resize(std::ssize(content->dofs), std::ssize(content->dofs));
  content->block.setFromTriplets(entries.begin(), entries.end());
  content_ = std::move(content);
}

Symmetric CompactMatrix::whole() const {
  Symmetric out(size_, size_);
  if (size_ == 0) return out;
  Triplets entries;
  for (int c = 0; c < block().outerSize(); ++c)
    for (Symmetric::InnerIterator e(block(), c); e; ++e)
      entries.emplace_back(dofs()[static_cast<std::size_t>(e.row())], dofs()[static_cast<std::size_t>(c)], e.value());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Eigen::MatrixXd CompactMatrix::times(double factor, const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size_, x.cols());
  if (size_ > 0) out(dofs(), Eigen::all) = (factor * block()) * Eigen::MatrixXd(x(dofs(), Eigen::all));
  return out;
}

}  // namespace twindeck::diagnosis
