#include "linalg/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "linalg/one_thread.hpp"

namespace twindeck::linalg {

namespace {

/// A pivot that is this small against the diagonal entry it started from is what rounding leaves of zero: a free structure or a
/// mechanism can pass CHOLMOD's test for a positive pivot by luck. A beam of 1000 elements still has 1e-10.
constexpr double kSingularPivot = 1e-13;

cholmod_sparse view(const SparseMatrix& lower) {
  cholmod_sparse a{};
  a.nrow = static_cast<std::size_t>(lower.rows());
  a.ncol = static_cast<std::size_t>(lower.cols());
  a.nzmax = static_cast<std::size_t>(lower.nonZeros());
  a.p = const_cast<int*>(lower.outerIndexPtr());
  a.i = const_cast<int*>(lower.innerIndexPtr());
  a.x = const_cast<double*>(lower.valuePtr());
  a.stype = -1;  // lower triangle
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

/// Squares of the factor's diagonal, in the order of elimination.
std::vector<double> pivots(const cholmod_factor& factor) {
  std::vector<double> pivot(factor.n);
  const auto* x = static_cast<const double*>(factor.x);
  if (factor.is_super) {
    const auto* super = static_cast<const int*>(factor.super);
    const auto* rows = static_cast<const int*>(factor.pi);
    const auto* start = static_cast<const int*>(factor.px);
    for (std::size_t s = 0; s < factor.nsuper; ++s) {
      const int height = rows[s + 1] - rows[s];
      for (int j = 0; j < super[s + 1] - super[s]; ++j) pivot[super[s] + j] = x[start[s] + j * (height + 1)];
    }
  } else {
    const auto* start = static_cast<const int*>(factor.p);
    for (std::size_t j = 0; j < factor.n; ++j) pivot[j] = x[start[j]];
  }
  for (double& value : pivot) value *= value;
  return pivot;
}

}  // namespace

/// Pattern of a lower triangle.
struct Pattern {
  std::vector<int> outer, inner;

  explicit Pattern(const SparseMatrix& a)
      : outer(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1),
        inner(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros()) {}
  bool is_of(const SparseMatrix& a) const {
    return outer.size() == static_cast<std::size_t>(a.outerSize() + 1) &&
           inner.size() == static_cast<std::size_t>(a.nonZeros()) &&
           std::equal(outer.begin(), outer.end(), a.outerIndexPtr()) &&
           std::equal(inner.begin(), inner.end(), a.innerIndexPtr());
  }
};

/// A symbolic factorisation with the pattern that it is of.
struct Symbolic {
  Pattern pattern;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;

  explicit Symbolic(const SparseMatrix& lower) : pattern(lower) {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_AUTO;
    const SerialScope serial;
    cholmod_sparse a = view(lower);
    factor = cholmod_analyze(&a, &common);
    TWINDECK_ASSERT(factor != nullptr);
  }
  ~Symbolic() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Symbolic(const Symbolic&) = delete;
  Symbolic& operator=(const Symbolic&) = delete;
};

namespace {

/// The symbolic factorisation of a pattern: found once and kept for the last few patterns, since prestress, modes, derivatives
/// and every start of an update factorise the same one.
std::shared_ptr<const Symbolic> symbolic_of(const SparseMatrix& lower) {
  constexpr std::size_t kept = 4;
  static std::mutex mutex;
  static std::deque<std::shared_ptr<const Symbolic>> known;  // newest first
  const std::lock_guard lock(mutex);
  const auto found = std::find_if(known.begin(), known.end(), [&](const auto& one) { return one->pattern.is_of(lower); });
  if (found != known.end()) return *found;
  known.push_front(std::make_shared<const Symbolic>(lower));
  if (known.size() > kept) known.pop_back();
  return known.front();
}

/// What cholmod_solve2 works in. A thread keeps its own, so that several can solve with one factor at a time.
struct SolveWorkspace {
  cholmod_common common{};
  cholmod_dense *solution = nullptr, *y = nullptr, *e = nullptr;

  SolveWorkspace() {
    cholmod_start(&common);
    common.print = 0;
  }
  ~SolveWorkspace() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_finish(&common);
  }
  SolveWorkspace(const SolveWorkspace&) = delete;
  SolveWorkspace& operator=(const SolveWorkspace&) = delete;
};

}  // namespace

struct Cholesky::Impl {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  std::shared_ptr<const Symbolic> symbolic;  // what `factor` started from, so that a changed pattern is noticed
  Eigen::Index failed = -1;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.final_ll = 1;  // LL': an indefinite matrix breaks down instead of giving negative pivots
    common.supernodal = CHOLMOD_AUTO;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool same_pattern(const SparseMatrix& a) const { return symbolic && symbolic->pattern.is_of(a); }

  Eigen::Index row_of(std::size_t column) const { return static_cast<const int*>(factor->Perm)[column]; }
};

Cholesky::Cholesky() : impl_(std::make_unique<Impl>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::analyze(const SparseMatrix& lower) {
  TWINDECK_ASSERT(lower.rows() == lower.cols() && lower.isCompressed());
  use_one_thread();
  cholmod_free_factor(&impl_->factor, &impl_->common);
  impl_->symbolic = symbolic_of(lower);
  impl_->factor = cholmod_copy_factor(impl_->symbolic->factor, &impl_->common);
  TWINDECK_ASSERT(impl_->factor != nullptr);
}

Status Cholesky::factorize(const SparseMatrix& lower) {
  if (!impl_->same_pattern(lower)) analyze(lower);
  use_one_thread();
  cholmod_sparse a = view(lower);
  impl_->failed = -1;
  const SerialScope serial;
  cholmod_factorize(&a, impl_->factor, &impl_->common);
  const cholmod_factor& factor = *impl_->factor;
  if (impl_->common.status == CHOLMOD_NOT_POSDEF) {
    impl_->failed = impl_->row_of(std::min(factor.minor, factor.n - 1));
    return {false, fmt::format("the matrix is not positive definite: elimination breaks down at row {}", impl_->failed + 1)};
  }
  TWINDECK_ASSERT(impl_->common.status >= CHOLMOD_OK);

  const std::vector<double> pivot = pivots(factor);
  const Eigen::VectorXd diagonal = lower.diagonal();
  for (std::size_t j = 0; j < pivot.size(); ++j) {
    const Eigen::Index row = impl_->row_of(j);
    if (std::isfinite(pivot[j]) && pivot[j] > kSingularPivot * std::abs(diagonal[row])) continue;
    impl_->failed = row;
    return {false,
            fmt::format("the matrix is singular to working precision: the pivot of row {} is {:.1e} of its diagonal entry",
                        row + 1, pivot[j] / diagonal[row])};
  }
  return {};
}

Eigen::Index Cholesky::failed_column() const { return impl_->failed; }

Eigen::MatrixXd Cholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  TWINDECK_ASSERT(impl_->factor != nullptr && impl_->failed < 0);
  TWINDECK_ASSERT(static_cast<std::size_t>(b.rows()) == impl_->factor->n);
  if (b.cols() == 0) return Eigen::MatrixXd(b.rows(), 0);
  cholmod_dense right{};
  right.nrow = static_cast<std::size_t>(b.rows());
  right.ncol = static_cast<std::size_t>(b.cols());
  right.d = static_cast<std::size_t>(b.outerStride());
  right.nzmax = right.d * right.ncol;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  thread_local SolveWorkspace work;
  const SerialScope serial;
  const int solved =
      cholmod_solve2(CHOLMOD_A, impl_->factor, &right, nullptr, &work.solution, nullptr, &work.y, &work.e, &work.common);
  TWINDECK_ASSERT(solved == 1);
  return Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>(
      static_cast<const double*>(work.solution->x), b.rows(), b.cols(),
      Eigen::OuterStride<>(static_cast<Eigen::Index>(work.solution->d)));
}

}  // namespace twindeck::linalg
