#pragma once

#include <vector>

#include "fe/parametric_system.hpp"

namespace twindeck::fe {

/// sum a_g(theta) K_g, lower triangle on the pattern.
[[nodiscard]] linalg::SparseMatrix combine(const linalg::SparseMatrix& pattern, const std::vector<Term>& terms,
                                           const Eigen::VectorXd& theta);

}  // namespace twindeck::fe
