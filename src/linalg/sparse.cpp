#include "linalg/sparse.hpp"

#include <Eigen/CholmodSupport>

namespace twindeck::linalg {

Eigen::MatrixXd symmetric_product(const SparseMatrix& lower, const Eigen::Ref<const Eigen::MatrixXd>& x) {
  Eigen::MatrixXd y(x.rows(), x.cols());
  cholmod_sparse a = Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>());
  cholmod_dense from = Eigen::viewAsCholmod(x.const_cast_derived()), to = Eigen::viewAsCholmod(y);
  double one[] = {1.0, 0.0}, zero[] = {0.0, 0.0};
  cholmod_common common;
  cholmod_start(&common);
  cholmod_sdmult(&a, 0, one, zero, &from, &to, &common);  // multiplies four columns at a time; Eigen's product takes one
  cholmod_finish(&common);
  return y;
}

}  // namespace twindeck::linalg
