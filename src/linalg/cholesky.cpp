#include "linalg/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <type_traits>
#include <vector>

#include "linalg/lane_kernels.hpp"
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

SupernodalFactor blocks_of(const cholmod_factor& factor) {
  return {factor.n,
          factor.nsuper,
          static_cast<const int*>(factor.super),
          static_cast<const int*>(factor.pi),
          static_cast<const int*>(factor.px),
          static_cast<const int*>(factor.s),
          static_cast<const double*>(factor.x)};
}

/// P' L^-T L^-1 P of columns first … first + count - 1 of b, Width at a time; lanes without a column carry zeros.
template <Eigen::Index Width>
void solve_lanes(const cholmod_factor& factor, SupernodalSweep sweep, const Eigen::Ref<const Eigen::MatrixXd>& b,
                 Eigen::Index first, Eigen::Index count, std::vector<double>& y, Eigen::MatrixXd& x) {
  const auto* order = static_cast<const int*>(factor.Perm);
  const auto n = static_cast<Eigen::Index>(factor.n);
  if (y.size() < static_cast<std::size_t>(Width * n)) y.resize(static_cast<std::size_t>(Width * n));
  for (Eigen::Index k = 0; k < n; ++k) {
    double* entries = y.data() + Width * k;
    for (Eigen::Index c = 0; c < count; ++c) entries[c] = b(order[k], first + c);
    for (Eigen::Index c = count; c < Width; ++c) entries[c] = 0.0;
  }
  sweep(blocks_of(factor), y.data());
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index c = 0; c < count; ++c) x(order[k], first + c) = y[static_cast<std::size_t>(Width * k + c)];
}

Eigen::MatrixXd solve_by_blocks(const cholmod_factor& factor, const Eigen::Ref<const Eigen::MatrixXd>& b) {
  const LaneKernels& kernels = lane_kernels();
  Eigen::MatrixXd x(b.rows(), b.cols());
  thread_local std::vector<double> y;  // kept: fresh pages for each solve cost as much as a tenth of it
  Eigen::Index first = 0;
  const auto take = [&](auto width, SupernodalSweep sweep) {
    const Eigen::Index count = std::min<Eigen::Index>(width, b.cols() - first);
    solve_lanes<width>(factor, sweep, b, first, count, y, x);
    first += count;
  };
  while (b.cols() - first > 8) take(std::integral_constant<Eigen::Index, 16>(), kernels.sweep_16);
  if (b.cols() - first > 4) take(std::integral_constant<Eigen::Index, 8>(), kernels.sweep_8);
  if (b.cols() - first > 0) take(std::integral_constant<Eigen::Index, 4>(), kernels.sweep_4);
  return x;
}

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

/// A lower triangle in the order of elimination: its pattern, and which of the values of the one given belongs where.
struct Permuted {
  std::vector<int> outer, inner, source;

  Permuted(const SparseMatrix& lower, const int* order) : outer(static_cast<std::size_t>(lower.cols()) + 1, 0) {
    const Eigen::Index n = lower.cols();
    std::vector<int> place(static_cast<std::size_t>(n));
    for (Eigen::Index k = 0; k < n; ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
    const auto at = [&](int i) { return place[static_cast<std::size_t>(i)]; };
    // Sorted by row, then, keeping that order, by column.
    std::vector<int> row_end(outer);
    const int *from = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
    for (int j = 0; j < n; ++j) {
      for (int k = from[j]; k < from[j + 1]; ++k) {
        ++outer[static_cast<std::size_t>(std::min(at(j), at(row[k]))) + 1];
        ++row_end[static_cast<std::size_t>(std::max(at(j), at(row[k]))) + 1];
      }
    }
    std::partial_sum(outer.begin(), outer.end(), outer.begin());
    std::partial_sum(row_end.begin(), row_end.end(), row_end.begin());
    std::vector<std::array<int, 3>> by_row(static_cast<std::size_t>(lower.nonZeros()));  // row, column, place among the values
    for (int j = 0; j < n; ++j) {
      for (int k = from[j]; k < from[j + 1]; ++k) {
        const int column = std::min(at(j), at(row[k])), down = std::max(at(j), at(row[k]));
        by_row[static_cast<std::size_t>(row_end[static_cast<std::size_t>(down)]++)] = {down, column, k};
      }
    }
    inner.resize(by_row.size());
    source.resize(by_row.size());
    std::vector<int> next(outer);
    for (const auto& [down, column, k] : by_row) {
      const auto to = static_cast<std::size_t>(next[static_cast<std::size_t>(column)]++);
      inner[to] = down;
      source[to] = k;
    }
  }
};

/// A symbolic factorisation with the pattern that it is of.
struct Symbolic {
  Pattern pattern;
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  std::optional<Permuted> permuted;  // of a supernodal factor

  explicit Symbolic(const SparseMatrix& lower) : pattern(lower) {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_AUTO;
    const SerialScope serial;
    cholmod_sparse a = view(lower);
    factor = cholmod_analyze(&a, &common);
    TWINDECK_ASSERT(factor != nullptr);
    if (factor->is_super == 0) return;
    // CHOLMOD would permute each new matrix twice over, a sixth of a factorisation. It takes one that is permuted already as it
    // is, if the factor says so; nothing else of ours asks the factor for its ordering.
    permuted.emplace(lower, static_cast<const int*>(factor->Perm));
    factor->ordering = CHOLMOD_NATURAL;
  }
  ~Symbolic() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Symbolic(const Symbolic&) = delete;
  Symbolic& operator=(const Symbolic&) = delete;
};

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

}  // namespace

struct Cholesky::Impl {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  std::shared_ptr<const Symbolic> symbolic;  // what `factor` started from, so that a changed pattern is noticed
  Eigen::Index failed = -1;
  std::vector<double> values;  // of the permuted matrix
  // Workspace of cholmod_solve2, kept between calls; one call at a time.
  std::mutex solving;
  cholmod_dense *solution = nullptr, *y = nullptr, *e = nullptr;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.final_ll = 1;  // LL': an indefinite matrix breaks down instead of giving negative pivots
    common.supernodal = CHOLMOD_AUTO;
  }
  ~Impl() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
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
  if (const std::optional<Permuted>& permuted = impl_->symbolic->permuted) {
    std::vector<double>& values = impl_->values;
    values.resize(permuted->source.size());
    std::transform(permuted->source.begin(), permuted->source.end(), values.begin(),
                   [&](int k) { return lower.valuePtr()[k]; });
    a.p = const_cast<int*>(permuted->outer.data());
    a.i = const_cast<int*>(permuted->inner.data());
    a.x = values.data();
  }
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

LaneBasis Cholesky::solve(const LaneBasis& b) const {
  if (impl_->factor->is_super == 0) return LaneBasis(solve(b.dense()));
  const auto* order = static_cast<const int*>(impl_->factor->Perm);
  const Eigen::Index n = b.rows();
  LaneBasis x(n);
  Eigen::MatrixXd y;
  for (std::size_t first = 0; first < b.blocks().size();) {
    const bool two = first + 1 < b.blocks().size();  // what the factor is read for
    y.resize(two ? 16 : 8, n);
    for (std::size_t j = 0; j < (two ? 2 : 1); ++j) {
      const Lanes& from = b.blocks()[first + j].lanes;
      for (Eigen::Index k = 0; k < n; ++k) y.col(k).segment<8>(8 * static_cast<Eigen::Index>(j)) = from.col(order[k]);
    }
    (two ? lane_kernels().sweep_16 : lane_kernels().sweep_8)(blocks_of(*impl_->factor), y.data());
    for (std::size_t j = 0; j < (two ? 2 : 1); ++j) {
      Lanes to(8, n);
      for (Eigen::Index k = 0; k < n; ++k) to.col(order[k]) = y.col(k).segment<8>(8 * static_cast<Eigen::Index>(j));
      x.append(std::move(to), b.blocks()[first + j].columns);
    }
    first += two ? 2 : 1;
  }
  return x;
}

Eigen::MatrixXd Cholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  TWINDECK_ASSERT(impl_->factor != nullptr && impl_->failed < 0);
  TWINDECK_ASSERT(static_cast<std::size_t>(b.rows()) == impl_->factor->n);
  if (b.cols() == 0) return Eigen::MatrixXd(b.rows(), 0);
  if (impl_->factor->is_super) return solve_by_blocks(*impl_->factor, b);
  cholmod_dense right{};
  right.nrow = static_cast<std::size_t>(b.rows());
  right.ncol = static_cast<std::size_t>(b.cols());
  right.d = static_cast<std::size_t>(b.outerStride());
  right.nzmax = right.d * right.ncol;
  right.x = const_cast<double*>(b.data());
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  const std::lock_guard lock(impl_->solving);
  const SerialScope serial;
  const int solved = cholmod_solve2(CHOLMOD_A, impl_->factor, &right, nullptr, &impl_->solution, nullptr, &impl_->y, &impl_->e,
                                    &impl_->common);
  TWINDECK_ASSERT(solved == 1);
  return Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>(
      static_cast<const double*>(impl_->solution->x), b.rows(), b.cols(),
      Eigen::OuterStride<>(static_cast<Eigen::Index>(impl_->solution->d)));
}

}  // namespace twindeck::linalg
