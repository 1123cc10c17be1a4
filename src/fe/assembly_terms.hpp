#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/dof_map.hpp"

namespace twindeck::fe {

/// A term a_g K_g before it is assembled: its coefficient and the element matrices that it sums.
struct TermPlan {
  std::string label;
  Coefficient coefficient;
  std::vector<int> parts;                                     ///< elements, springs or masses
  ElementMatrix (*matrix)(const Model&, int part) = nullptr;  ///< matrix of one part at the model's own values
  bool of_elements = false;                                   ///< its parts are elements
};

/// Powers of the properties in the coefficient of a term.
struct Powers {
  double modulus = 0.0, density = 0.0, area = 0.0, thickness = 0.0, ratio = 0.0;
};

/// Plans by label, in order of first appearance: one term for all parts with the same coefficient.
class TermGroups {
 public:
  /// Adds a part; `matrix` and the coefficient are those of the first part with this label.
  TermPlan& add(const std::string& label, int part, ElementMatrix (*matrix)(const Model&, int));
  /// The same for an element, whose coefficient follows from the powers and its material and section.
  void add_element(const Model& model, int i, const std::string& label, const Powers& powers,
                   ElementMatrix (*matrix)(const Model&, int));
  [[nodiscard]] std::vector<TermPlan> take() { return std::move(plans_); }

 private:
  std::map<std::string, std::size_t> index_;
  std::vector<TermPlan> plans_;
};

/// Sums the plans over the pattern in parallel. One thread sums each term in the order of its parts, so that the result does
/// not depend on the number of threads. Terms without an entry (all parts on supports) are left out.
[[nodiscard]] std::vector<Term> assemble_terms(const Model& model, const std::vector<TermPlan>& plans,
                                               const linalg::SparseMatrix& pattern, const DofMap& map);

/// Factor (theta / current value)^power of one material, section or group, if a parameter scales it; a model has one for each
/// property at most (validate_parameters).
[[nodiscard]] std::optional<ParameterFactor> factor_of(const Model& model, Target target, const std::string& name,
                                                       double power);
/// Gives it to a coefficient.
void add_factor(const Model& model, Target target, const std::string& name, double power, Coefficient& coefficient);
[[nodiscard]] bool is_parameter(const Model& model, Target target, const std::string& name);

/// Dischinger's modulus of a stay under its cable force, with the horizontal projection of its chord, and how parameters move
/// it.
[[nodiscard]] StayModulus stay_modulus(const Model& model, const Element& stay, double pull_N);

}  // namespace twindeck::fe
