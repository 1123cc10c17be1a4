#pragma once

#include <string>
#include <vector>

#include "diagnosis/reduction/structure.hpp"
#include "fe/assembly_terms.hpp"

/// Private to src/diagnosis: how elements and springs go with the parameters of a finite element model.
namespace twindeck::diagnosis {

class ElementLaws {
 public:
  using Law = ParameterLaw<CompactMatrix>;

  explicit ElementLaws(const Structure& structure);

  /// Of what elements, and springs between nodes, add to a matrix together.
  [[nodiscard]] Law stiffness(const std::vector<int>& elements, const std::vector<const fe::Spring*>& springs = {}) const;
  [[nodiscard]] Law mass(const std::vector<int>& elements) const;
  /// Of a spring's stiffness.
  [[nodiscard]] fe::Coefficient of_spring(const fe::Spring& spring) const;

 private:
  /// Terms of the system's matrix before they are assembled, and those that each element is in.
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

}  // namespace twindeck::diagnosis
