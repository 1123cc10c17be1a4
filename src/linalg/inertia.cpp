#include "linalg/inertia.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "linalg/one_thread.hpp"

namespace twindeck::linalg {

int count_eigenvalues_below(const SparseMatrix& stiffness, const SparseMatrix& mass, double value) {
  use_one_thread();
  SparseMatrix shifted = stiffness - value * mass;
  shifted.makeCompressed();
  cholmod_common common{};
  cholmod_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SIMPLICIAL;  // LDL' with pivots of either sign; the supernodal one is LL' only
  common.final_ll = 0;
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(shifted.rows());
  a.nzmax = static_cast<std::size_t>(shifted.nonZeros());
  a.p = shifted.outerIndexPtr();
  a.i = shifted.innerIndexPtr();
  a.x = shifted.valuePtr();
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  cholmod_factor* factor = cholmod_analyze(&a, &common);
  cholmod_factorize(&a, factor, &common);
  const bool complete = factor != nullptr && common.status == CHOLMOD_OK && factor->minor == factor->n;
  int below = 0;
  bool zero_pivot = !complete;
  if (complete) {
    const auto* start = static_cast<const int*>(factor->p);
    const auto* x = static_cast<const double*>(factor->x);
    for (std::size_t j = 0; j < factor->n; ++j) {
      const double pivot = x[start[j]];
      below += pivot < 0.0 ? 1 : 0;
      zero_pivot = zero_pivot || pivot == 0.0 || !std::isfinite(pivot);
    }
  }
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  if (zero_pivot) {
    throw InputError({},
                     fmt::format("{} is an eigenvalue to working precision, so that those below it can't be counted", value),
                     "take a value between two eigenvalues");
  }
  return below;
}

}  // namespace twindeck::linalg
