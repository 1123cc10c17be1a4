#include "diagnosis/reduction/element_laws.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "fe/assembly_plans.hpp"

namespace twindeck::diagnosis {

ElementLaws::ElementLaws(const Structure& structure) : structure_(structure) {
  const fe::Model& model = *structure.model;
  if (model.parameters.empty()) return;
  std::vector<fe::TermPlan> stiffness = fe::plan_stiffness(model);
  std::vector<fe::TermPlan> stays =
      fe::plan_stays(model, structure.state != nullptr ? structure.state->stay_pull_N : Eigen::VectorXd());
  stiffness.insert(stiffness.end(), std::make_move_iterator(stays.begin()), std::make_move_iterator(stays.end()));
  stiffness_ = collected(std::move(stiffness));
  mass_ = collected(fe::plan_mass(model));
}

ElementLaws::Plans ElementLaws::collected(std::vector<fe::TermPlan> plans) const {
  Plans out;
  std::erase_if(plans, [](const fe::TermPlan& plan) { return !plan.of_elements; });
  out.plans = std::move(plans);
  out.of_element.resize(structure_.model->elements.size());
  for (std::size_t i = 0; i < out.plans.size(); ++i) {
    out.ratio.push_back(position_of(ratio_of(out.plans[i].coefficient, structure_.theta), out.ratios));
    for (const int e : out.plans[i].parts) out.of_element[static_cast<std::size_t>(e)].push_back(i);
  }
  return out;
}

fe::Coefficient ElementLaws::of_spring(const fe::Spring& spring) const {
  fe::Coefficient coefficient;
  fe::add_factor(*structure_.model, fe::Target::spring_stiffness, spring.group, 1.0, coefficient);
  return ratio_of(coefficient, structure_.theta);
}

ElementLaws::Law ElementLaws::law(const Plans& from, const std::vector<int>& elements,
                                  const std::vector<const fe::Spring*>& springs) const {
  Law out;
  if (structure_.model->parameters.empty()) return out;
  std::vector<fe::Coefficient> ratios = from.ratios;
  std::vector<std::size_t> of_springs;
  for (const fe::Spring* spring : springs) of_springs.push_back(position_of(of_spring(*spring), ratios));
  std::vector<int> count(ratios.size(), 0);
  const auto plans_of = [&](int e) -> const auto& { return from.of_element[static_cast<std::size_t>(e)]; };
  for (const int e : elements)
    for (const std::size_t plan : plans_of(e)) ++count[from.ratio[plan]];
  for (const std::size_t ratio : of_springs) ++count[ratio];
  if (count.empty()) return out;
  const auto most = static_cast<std::size_t>(std::max_element(count.begin(), count.end()) - count.begin());
  out.ratio = ratios[most];

  const Eigen::SparseMatrix<double>& expansion = structure_.system->expansion;
  std::vector<ElementSum> sums(ratios.size(), ElementSum{expansion.rows(), {}});
  for (const int e : elements)
    for (const std::size_t plan : plans_of(e))
      if (from.ratio[plan] != most)
        sums[from.ratio[plan]].add(from.plans[plan].matrix(*structure_.model, e),
                                   from.plans[plan].coefficient.value(structure_.theta));
  for (std::size_t i = 0; i < springs.size(); ++i)
    if (of_springs[i] != most) sums[of_springs[i]].add(fe::spring_stiffness(*springs[i]));
  for (std::size_t i = 0; i < ratios.size(); ++i)
    if (!sums[i].entries.empty()) out.parts.push_back({ratios[i], 1.0, CompactMatrix(sums[i].free(expansion))});
  return out;
}

ElementLaws::Law ElementLaws::stiffness(const std::vector<int>& elements, const std::vector<const fe::Spring*>& springs) const {
  return law(stiffness_, elements, springs);
}

ElementLaws::Law ElementLaws::mass(const std::vector<int>& elements) const { return law(mass_, elements, {}); }

}  // namespace twindeck::diagnosis
