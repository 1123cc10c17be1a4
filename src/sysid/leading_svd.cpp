#include "sysid/leading_svd.hpp"

#include <Eigen/SVD>

#include "core/error.hpp"

namespace twindeck::sysid {

LeadingSvd leading_svd(const Eigen::MatrixXd& a, Eigen::Index n) {
  TWINDECK_ASSERT(n <= std::min(a.rows(), a.cols()));
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU);
  LeadingSvd result{svd.matrixU().leftCols(n), svd.singularValues().head(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::Index largest = 0;
    result.u.col(j).cwiseAbs().maxCoeff(&largest);
    if (result.u(largest, j) < 0.0) result.u.col(j) *= -1.0;
  }
  return result;
}

}  // namespace twindeck::sysid
