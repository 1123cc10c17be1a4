#pragma once

#include <vector>

#include "fe/assembly_elements.hpp"
#include "fe/dof_map.hpp"
#include "fe/parametric_system.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::fe {

/// The one sparsity pattern (lower triangle, explicit zeros, whole diagonal) that holds every element, spring and mass.
[[nodiscard]] linalg::SparseMatrix make_pattern(const Model& model, const DofMap& map);

/// Adds element matrices over full degrees of freedom, E' K_e E, into one array over the pattern's entries.
class Scatter {
 public:
  Scatter(const linalg::SparseMatrix& pattern, const DofMap& map);
  void add(const ElementMatrix& element);
  /// The sum as positions (ascending) and values without zeros; the array is cleared for the next term.
  void take(Term& term);

 private:
  [[nodiscard]] int position(int row, int column, int after) const;

  const linalg::SparseMatrix& pattern_;
  const DofMap& map_;
  std::vector<double> sum_;  ///< (non-zeros of the pattern)
  std::vector<char> is_touched_;
  std::vector<int> touched_;
};

}  // namespace twindeck::fe
