#include "diagnosis/reduction/reduced_matrix.hpp"

#include "core/error.hpp"
#include "linalg/dense.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kAtOnce = 256;  ///< columns of V that are projected together; their images take n × 256 numbers

}  // namespace

ReducedMatrix::ReducedMatrix(CompactMatrix s, std::shared_ptr<const ReducedBasis> basis, bool for_all)
    : basis_(std::move(basis)), s_(std::move(s)), for_all_(for_all), known_(std::make_shared<Known>()) {
  local_ = std::ssize(s_.dofs()) <= basis_->common();
  MatrixXd shared = basis_->common_rows()(Eigen::all, s_.dofs());
  const MatrixXd image = linalg::product(s_.block(), shared.transpose());
  common_ = linalg::product(shared, image);
  common_.triangularView<Eigen::StrictlyLower>() = common_.transpose();
  if (local_) common_at_dofs_ = std::move(shared);
  follow_basis();
}

void ReducedMatrix::keep(int group) {
  if (basis_ == nullptr || !local_) return;
  own_at_dofs_ = at_dofs(group);
  own_group_ = group;
}

void ReducedMatrix::follow_basis() {
  if (local_ || !for_all_ || basis_ == nullptr) return;
  const std::vector<ReducedBasis::Group>& groups = basis_->groups();
  const Index c = basis_->common();
  const MatrixXd common_here = basis_->common_rows()(Eigen::all, s_.dofs());
  while (all_.size() < groups.size()) {
    const std::size_t begin = all_.size();
    std::size_t end = begin + 1;
    const auto columns_to = [&](std::size_t g) { return groups[g - 1].first + groups[g - 1].count - groups[begin].first; };
    while (end < groups.size() && columns_to(end + 1) <= kAtOnce) ++end;
    MatrixXd here(common_here.cols(), columns_to(end));
    for (std::size_t g = begin; g < end; ++g)
      here.middleCols(groups[g].first - groups[begin].first, groups[g].count) = at_dofs(static_cast<int>(g));
    const MatrixXd image = linalg::product(s_.block(), here);
    const MatrixXd shared = linalg::product(common_here, image);
    for (std::size_t g = begin; g < end; ++g) {
      const Index at = groups[g].first - groups[begin].first, count = groups[g].count;
      MatrixXd& out = all_.emplace_back(c + count, count);
      out.topRows(c) = shared.middleCols(at, count);
      out.bottomRows(count) = here.middleCols(at, count).transpose() * image.middleCols(at, count);
    }
  }
}

MatrixXd ReducedMatrix::at_dofs(int group) const {
  if (group == own_group_) return own_at_dofs_;
  return (*basis_->vectors(group))(s_.dofs(), Eigen::all);
}

const MatrixXd& ReducedMatrix::own(int group) const {
  if (for_all_ && !local_) return all_[static_cast<std::size_t>(group)];
  return known(known_->own, group, [&] {
    const MatrixXd here = at_dofs(group), image = s_.block() * here;
    MatrixXd out(basis_->common() + here.cols(), here.cols());
    out << linalg::product(basis_->common_rows()(Eigen::all, s_.dofs()), image), here.transpose() * image;
    return out;
  });
}

const MatrixXd& ReducedMatrix::cross(int low, int high) const {
  return known(known_->cross, std::pair{low, high}, [&] {
    const MatrixXd image = s_.block() * at_dofs(high);
    return MatrixXd(at_dofs(low).transpose() * image);
  });
}

double ReducedMatrix::entry(int row, int column) const {
  const auto [a, i] = basis_->place_of(row);
  const auto [b, j] = basis_->place_of(column);
  if (a == b) return own(a)(basis_->common() + i, j);
  return a < b ? cross(a, b)(i, j) : cross(b, a)(j, i);
}

void ReducedMatrix::add_own(double amount, const std::vector<int>& columns, Eigen::Ref<MatrixXd> total) const {
  const Index c = basis_->common(), n = std::ssize(columns);
  TWINDECK_ASSERT(n >= c && (c == 0 || columns[static_cast<std::size_t>(c) - 1] == c - 1));
  if (n == c) return;
  if (local_) {  // the matrix touches few degrees of freedom, so that nothing is kept
    MatrixXd here(std::ssize(s_.dofs()), n - c), values;
    int known = -1;
    for (Index k = c; k < n; ++k) {
      const auto [group, at] = basis_->place_of(columns[static_cast<std::size_t>(k)]);
      if (group != known) values = at_dofs(group);
      known = group;
      here.col(k - c) = values.col(at);
    }
    const MatrixXd image = amount * (s_.block() * here);
    total.topRows(c).noalias() += common_at_dofs_ * image;
    total.bottomRows(n - c).noalias() += here.transpose() * image;
    return;
  }
  for (Index k = c; k < n; ++k) {
    const int column = columns[static_cast<std::size_t>(k)];
    const auto [group, at] = basis_->place_of(column);
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
  const std::vector<int>& dofs = s_.dofs();
  for (int j = 0; j < s_.block().outerSize(); ++j)
    for (Symmetric::InnerIterator e(s_.block(), j); e; ++e) {
      const int from = dofs[static_cast<std::size_t>(j)], to = dofs[static_cast<std::size_t>(e.row())];
      for (Index k = 0; k < motion.cols(); ++k) force(to, k) += e.value() * (amount * motion(from, k));
    }
}

void ReducedMatrix::add_product(double amount, const MatrixXd& own, const MatrixXd& motion, Eigen::Ref<MatrixXd> sum) const {
  const MatrixXd image = amount * (s_.block() * MatrixXd(motion(s_.dofs(), Eigen::all)));
  const Index c = basis_->common();
  sum.topRows(c).noalias() += common_at_dofs_ * image;
  if (own.cols() > 0) sum.middleRows(c, own.cols()).noalias() += MatrixXd(own(s_.dofs(), Eigen::all)).transpose() * image;
}

}  // namespace twindeck::diagnosis
