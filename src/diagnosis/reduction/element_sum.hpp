#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "diagnosis/reduction/compact_matrix.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::diagnosis {

/// Element matrices that are added up over full degrees of freedom.
struct ElementSum {
  Eigen::Index size = 0;
  std::vector<Eigen::Triplet<double>> entries;

  void add(const fe::ElementMatrix& part, double factor = 1.0) {
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      for (std::size_t j = 0; j < part.dofs.size(); ++j) {
        const double value = part.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (value != 0.0) entries.emplace_back(part.dofs[i], part.dofs[j], factor * value);
      }
  }
  /// The same over the free degrees of freedom. @param expansion  of the system
  [[nodiscard]] Symmetric free(const Eigen::SparseMatrix<double>& expansion) const {
    Eigen::SparseMatrix<double> full(size, size);
    full.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SparseMatrix<double> right = full * expansion;
    Symmetric reduced = expansion.transpose() * right;
    reduced.prune(0.0);
    return reduced;
  }
};

}  // namespace twindeck::diagnosis
