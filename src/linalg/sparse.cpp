#include "linalg/sparse.hpp"

#include <Eigen/CholmodSupport>

namespace twindeck::linalg {

namespace {

Eigen::MatrixXd product_of(cholmod_sparse a, const Eigen::Ref<const Eigen::MatrixXd>& x) {
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(a.nrow), x.cols());
  if (y.size() == 0 || x.rows() == 0) return y;
  cholmod_dense from = Eigen::viewAsCholmod(x.const_cast_derived()), to = Eigen::viewAsCholmod(y);
  double one[] = {1.0, 0.0}, zero[] = {0.0, 0.0};
  cholmod_common common;
  cholmod_start(&common);
  cholmod_sdmult(&a, 0, one, zero, &from, &to, &common);
  cholmod_finish(&common);
  return y;
}

}  // namespace

Eigen::MatrixXd product(const SparseMatrix& a, const Eigen::Ref<const Eigen::MatrixXd>& x) {
  return product_of(Eigen::viewAsCholmod(Eigen::Ref<SparseMatrix>(a.const_cast_derived())), x);
}

Eigen::MatrixXd symmetric_product(const SparseMatrix& lower, const Eigen::Ref<const Eigen::MatrixXd>& x) {
  return product_of(Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>()), x);
}

}  // namespace twindeck::linalg
