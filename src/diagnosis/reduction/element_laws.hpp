#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "diagnosis/reduction/compact_matrix.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/assembly_terms.hpp"

/// Private to src/diagnosis: dependence of elements and springs on the parameters of a finite element model.
namespace twindeck::diagnosis {

class ElementLaws {
 public:
  using Law = ParameterLaw<CompactMatrix>;

  explicit ElementLaws(const Structure& structure);

  /// Law of the sum of elements, and of springs between nodes, in a matrix.
  [[nodiscard]] Law stiffness(const std::vector<int>& elements, const std::vector<const fe::Spring*>& springs = {}) const;
  [[nodiscard]] Law mass(const std::vector<int>& elements) const;
  /// Law of a spring's stiffness.
  [[nodiscard]] fe::Coefficient of_spring(const fe::Spring& spring) const;

 private:
  /// Terms of the system's matrix before assembly, and the terms of each element.
  struct Plans {
    std::vector<fe::TermPlan> plans;
    std::vector<std::size_t> ratio;                    ///< (n_plans) position in `ratios`
    std::vector<fe::Coefficient> ratios;               ///< each once
    std::vector<std::vector<std::size_t>> of_element;  ///< (n_elements) positions in `plans`
  };
  [[nodiscard]] Plans collected(std::vector<fe::TermPlan> plans) const;
  [[nodiscard]] Law law(const Plans& from, const std::vector<int>& elements,
                        const std::vector<const fe::Spring*>& springs) const;

  const Structure& structure_;
  Plans stiffness_, mass_;  ///< empty for a model without parameters
};

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
