#pragma once

#include <vector>

#include "fe/parametric_system.hpp"

namespace twindeck::fe {

/// sum a_g(theta) K_g, lower triangle on the pattern.
[[nodiscard]] linalg::SparseMatrix combine(const linalg::SparseMatrix& pattern, const std::vector<Term>& terms,
                                           const Eigen::VectorXd& theta);

/// Calls use(row, column, value) for each entry of the term's lower triangle.
template <typename Use>
void for_each_entry(const linalg::SparseMatrix& pattern, const Term& term, const Use& use) {
  const int* outer = pattern.outerIndexPtr();
  int column = 0;
  for (std::size_t i = 0; i < term.position.size(); ++i) {
    const int position = term.position[i];
    if (position < outer[column]) column = 0;  // positions ascend where we assembled them; an imported term may not
    while (position >= outer[column + 1]) ++column;
    use(pattern.innerIndexPtr()[position], column, term.value[i]);
  }
}

}  // namespace twindeck::fe
