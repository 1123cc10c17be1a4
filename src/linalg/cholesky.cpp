#include "linalg/cholesky.hpp"

#include <fmt/format.h>

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "linalg/one_thread.hpp"

namespace twindeck::linalg {

namespace {

/// [-] Pivot over its diagonal entry, below which the matrix counts as singular. The pivot of a free structure or a mechanism
/// should be zero, but rounding may leave a positive one, which CHOLMOD accepts. A beam of 1000 elements has 1e-10.
constexpr double kSingularPivot = 1e-13;

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

struct CholmodSession {
  cholmod_common common{};

  CholmodSession() {
    cholmod_start(&common);
    common.print = 0;
  }
  ~CholmodSession() { cholmod_finish(&common); }
  CholmodSession(const CholmodSession&) = delete;
  CholmodSession& operator=(const CholmodSession&) = delete;
};

/// @throws std::bad_alloc  where CHOLMOD was refused memory
static void check_memory(const cholmod_common& common) {
  if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
}

/// A symbolic factorisation and the matrix pattern that it belongs to.
struct Symbolic : CholmodSession {
  std::vector<int> outer, inner;
  cholmod_factor* factor = nullptr;

  explicit Symbolic(const SparseMatrix& lower)
      : outer(lower.outerIndexPtr(), lower.outerIndexPtr() + lower.outerSize() + 1),
        inner(lower.innerIndexPtr(), lower.innerIndexPtr() + lower.nonZeros()) {
    const SerialScope serial;
    cholmod_sparse a = Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>());
    factor = cholmod_analyze(&a, &common);
    check_memory(common);
    TWINDECK_ASSERT(factor != nullptr);
  }
  ~Symbolic() { cholmod_free_factor(&factor, &common); }
  bool is_of(const SparseMatrix& a) const {
    return std::ranges::equal(outer, std::span(a.outerIndexPtr(), static_cast<std::size_t>(a.outerSize()) + 1)) &&
           std::ranges::equal(inner, std::span(a.innerIndexPtr(), static_cast<std::size_t>(a.nonZeros())));
  }
};

namespace {

/// The symbolic factorisation of a pattern, computed once. The last few are kept, because prestress, modes, derivatives and all
/// starts of an update factorise matrices of the same pattern.
std::shared_ptr<const Symbolic> symbolic_of(const SparseMatrix& lower) {
  constexpr std::size_t kept = 4;
  static std::mutex mutex;
  static std::deque<std::shared_ptr<const Symbolic>> known;  // newest first
  const std::lock_guard lock(mutex);
  const auto found = std::ranges::find_if(known, [&](const auto& one) { return one->is_of(lower); });
  if (found != known.end()) return *found;
  known.push_front(std::make_shared<const Symbolic>(lower));
  if (known.size() > kept) known.pop_back();
  return known.front();
}

/// Workspace of cholmod_solve2. Each thread has its own, so that several can solve with one factor at a time.
struct SolveWorkspace : CholmodSession {
  cholmod_dense *solution = nullptr, *y = nullptr, *e = nullptr;

  ~SolveWorkspace() {
    for (cholmod_dense** one : {&solution, &y, &e}) cholmod_free_dense(one, &common);
  }
};

}  // namespace

struct Cholesky::Impl : CholmodSession {
  cholmod_factor* factor = nullptr;
  std::shared_ptr<const Symbolic> symbolic;  // symbolic factorisation of `factor`; shows when the pattern changes
  Eigen::Index failed = -1;

  Impl() { common.final_ll = 1; }  // LL': an indefinite matrix breaks down instead of giving negative pivots
  ~Impl() { cholmod_free_factor(&factor, &common); }

  void start_from(std::shared_ptr<const Symbolic> pattern) {
    cholmod_free_factor(&factor, &common);
    symbolic = std::move(pattern);
    factor = cholmod_copy_factor(symbolic->factor, &common);
    check_memory(common);
    TWINDECK_ASSERT(factor != nullptr);
  }
  Eigen::Index row_of(std::size_t column) const { return static_cast<const int*>(factor->Perm)[column]; }
};

Cholesky::Cholesky() : impl_(std::make_unique<Impl>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;

Status Cholesky::factorize(const SparseMatrix& lower) {
  TWINDECK_ASSERT(lower.rows() == lower.cols() && lower.isCompressed());
  use_one_thread();
  if (!impl_->symbolic || !impl_->symbolic->is_of(lower)) impl_->start_from(symbolic_of(lower));
  impl_->failed = -1;
  const SerialScope serial;
  cholmod_sparse a = Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>());
  cholmod_factorize(&a, impl_->factor, &impl_->common);
  check_memory(impl_->common);
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
  TWINDECK_ASSERT(impl_->factor != nullptr && impl_->failed < 0 && static_cast<std::size_t>(b.rows()) == impl_->factor->n);
  if (b.cols() == 0) return Eigen::MatrixXd(b.rows(), 0);
  cholmod_dense right = Eigen::viewAsCholmod(b.const_cast_derived());
  thread_local SolveWorkspace work;
  const SerialScope serial;
  const int solved =
      cholmod_solve2(CHOLMOD_A, impl_->factor, &right, nullptr, &work.solution, nullptr, &work.y, &work.e, &work.common);
  check_memory(work.common);
  TWINDECK_ASSERT(solved == 1);
  return Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(work.solution->x), b.rows(), b.cols());
}

}  // namespace twindeck::linalg
