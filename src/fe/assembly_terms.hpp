#pragma once

#include <map>
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
};

/// Powers of a term's coefficient in the properties that it is made of.
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

/// Elastic stiffness without stays: beams by group and material (the axial part apart where an area is a parameter), bars,
/// shells by section and material (membrane with drilling ~ E t, bending ~ E t³ RMI), springs by group.
[[nodiscard]] std::vector<TermPlan> plan_stiffness(const Model& model);
/// Axial stiffness of stays, a term each: Dischinger's modulus at the pull; the full modulus of a stay without pull.
[[nodiscard]] std::vector<TermPlan> plan_stays(const Model& model, const Eigen::VectorXd& stay_pull_N);
/// Mass of beams by group, shells by section (translations ~ rho t, rotations ~ rho t³), bars and stays, point masses.
[[nodiscard]] std::vector<TermPlan> plan_mass(const Model& model);

/// Sums the plans over the pattern, side by side in several threads; each term is summed by one thread in the order of its parts,
/// so that it does not depend on their number. Terms without an entry (all of it on supports) are left out.
[[nodiscard]] std::vector<Term> assemble_terms(const Model& model, const std::vector<TermPlan>& plans,
                                               const linalg::SparseMatrix& pattern, const DofMap& map);

/// Factors of a coefficient for one material or section or group: (theta / value as it stands)^power for each parameter that
/// has this target and names this thing.
void add_factors(const Model& model, Target target, const std::string& name, double power, Coefficient& coefficient);
[[nodiscard]] bool is_parameter(const Model& model, Target target, const std::string& name);

/// Dischinger's reduction for a stay under a pull, with the horizontal projection of its chord.
[[nodiscard]] Dischinger sag_of(const Model& model, const Element& stay, double pull_N);

}  // namespace twindeck::fe
