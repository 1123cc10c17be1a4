#include "fe/assembly_terms.hpp"

#include "core/lists.hpp"
#include "core/parallel.hpp"
#include "fe/assembly_pattern.hpp"

namespace twindeck::fe {

std::optional<ParameterFactor> factor_of(const Model& model, Target target, const std::string& name, double power) {
  for (std::size_t p = 0; p < model.parameters.size(); ++p) {
    const Parameter& parameter = model.parameters[p];
    if (parameter.target != target) continue;
    if (!contains(parameter.of, name)) continue;
    return ParameterFactor{static_cast<int>(p), power, parameter.initial};
  }
  return std::nullopt;
}

bool is_parameter(const Model& model, Target target, const std::string& name) {
  return factor_of(model, target, name, 1.0).has_value();
}

void add_factor(const Model& model, Target target, const std::string& name, double power, Coefficient& coefficient) {
  if (const auto factor = factor_of(model, target, name, power)) coefficient.factors.push_back(*factor);
}

StayModulus stay_modulus(const Model& model, const Element& stay, double pull_N) {
  const auto ends = end_nodes(model, stay);
  const Eigen::Vector3d chord = ends[1] - ends[0];
  const Material& material = material_of(model, stay);
  const Section& section = section_of(model, stay);
  return {{material.density_kg_m3 * model.gravity_m_s2, chord.head<2>().norm(), pull_N / section.area_m2},
          material.youngs_modulus_Pa,
          factor_of(model, Target::youngs_modulus, material.name, 1.0),
          factor_of(model, Target::density, material.name, 1.0),
          factor_of(model, Target::area, section.name, 1.0)};
}

TermPlan& TermGroups::add(const std::string& label, int part, ElementMatrix (*matrix)(const Model&, int)) {
  const auto [found, is_new] = index_.try_emplace(label, plans_.size());
  if (is_new) plans_.push_back({label, {}, {}, matrix, false});
  TermPlan& plan = plans_[found->second];
  plan.parts.push_back(part);
  return plan;
}

void TermGroups::add_element(const Model& model, int i, const std::string& label, const Powers& powers,
                             ElementMatrix (*matrix)(const Model&, int)) {
  TermPlan& plan = add(label, i, matrix);
  plan.of_elements = true;
  if (plan.parts.size() > 1) return;
  const Element& e = model.elements[static_cast<std::size_t>(i)];
  const auto factor = [&](Target target, const std::string& name, double power) {
    if (power != 0.0) add_factor(model, target, name, power, plan.coefficient);
  };
  factor(Target::youngs_modulus, material_of(model, e).name, powers.modulus);
  factor(Target::density, material_of(model, e).name, powers.density);
  if (e.type == ElementType::solid) return;
  factor(Target::area, section_of(model, e).name, powers.area);
  factor(Target::thickness, section_of(model, e).name, powers.thickness);
  factor(Target::bending_inertia_ratio, section_of(model, e).name, powers.ratio);
}

std::vector<Term> assemble_terms(const Model& model, const std::vector<TermPlan>& plans, const linalg::SparseMatrix& pattern,
                                 const DofMap& map) {
  std::vector<Term> terms(plans.size());
  const auto scatter_of_thread = [&] { return Scatter(pattern, map); };
  parallel_for_with(plans.size(), scatter_of_thread, [&](Scatter& scatter, std::size_t i) {
    const TermPlan& plan = plans[i];
    terms[i].label = plan.label;
    terms[i].coefficient = plan.coefficient;
    for (const int part : plan.parts) scatter.add(plan.matrix(model, part));
    scatter.take(terms[i]);
  });
  std::erase_if(terms, [](const Term& term) { return term.position.empty(); });
  return terms;
}

}  // namespace twindeck::fe
