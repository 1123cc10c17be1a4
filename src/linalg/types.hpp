#pragma once

#include <Eigen/Sparse>

namespace twindeck::linalg {

/// Column-major sparse matrix with int indices (what CHOLMOD takes). A symmetric matrix holds both triangles unless its comment
/// says "lower triangle".
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

}  // namespace twindeck::linalg
