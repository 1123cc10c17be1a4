#pragma once

#include <Eigen/Sparse>

namespace twindeck::linalg {

/// Column-major sparse matrix with int indices (what CHOLMOD takes). Symmetric ones hold the lower triangle only where said so.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

}  // namespace twindeck::linalg
