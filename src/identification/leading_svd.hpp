#pragma once

#include <Eigen/Core>

namespace twindeck::identification {

/// Leading singular triplets of a dense matrix.
struct LeadingSvd {
  Eigen::MatrixXd u;       ///< (rows × n) orthonormal, entry of largest magnitude positive
  Eigen::VectorXd values;  ///< (n) descending
  Eigen::MatrixXd v;       ///< (columns × n) orthonormal
};

/// Leading n singular triplets of a dense matrix. Small ones by divide and conquer; large ones from the leading eigenvectors of
/// A Aᵀ (or AᵀA, whichever is smaller) and steps of subspace iteration with A itself, which restore the accuracy that the
/// square lost: triplets with sigma_n > 1e-7 sigma_1 have full accuracy.
[[nodiscard]] LeadingSvd leading_svd(const Eigen::MatrixXd& a, Eigen::Index n);

}  // namespace twindeck::identification
