#pragma once

#include <Eigen/Core>

namespace twindeck::sysid {

/// Leading singular triplets without the right vectors.
struct LeadingSvd {
  Eigen::MatrixXd u;        ///< (rows × n) orthonormal, entry of largest magnitude positive
  Eigen::VectorXd values;   ///< (n) descending
};

/// Leading n left singular vectors of a dense matrix, by divide and conquer on its triangular factor.
[[nodiscard]] LeadingSvd leading_svd(const Eigen::MatrixXd& a, Eigen::Index n);

}  // namespace twindeck::sysid
