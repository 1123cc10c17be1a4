#include "updating/structure_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/assembly_elements.hpp"
#include "fe/structure.hpp"
#include "linalg/sparse.hpp"
#include "updating/bounded_quadratic.hpp"
#include "updating/optimality.hpp"

namespace twindeck::updating {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Mass that a small matrix gives to a movement upwards of all its nodes.
double vertical_mass(const fe::ElementMatrix& mass) {
  double sum = 0.0;
  for (std::size_t j = 0; j < mass.dofs.size(); ++j)
    for (std::size_t i = 0; i < mass.dofs.size(); ++i)
      if (mass.dofs[i] % 6 == 2 && mass.dofs[j] % 6 == 2) sum += mass.matrix(static_cast<Index>(i), static_cast<Index>(j));
  return sum;
}

Index stay_position(const fe::Model& model, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    if (model.elements[e].type != fe::ElementType::stay) continue;
    if (model.elements[e].name == name) return static_cast<Index>(e);
    known.push_back(model.elements[e].name);
  }
  throw InputError({model.source, 0, name}, "is a stay that the model does not have" + did_you_mean(name, known),
                   "name a stay of the model");
}

struct Rows {
  VectorXd row;
  Index filled = 0;
  explicit Rows(Index n) : row(n) {}
  void add(double value) { row[filled++] = value; }
};

using Eigen::MatrixXd;

constexpr double kRangeStep =
    1e-5;  ///< [-] of a range: a difference of matrices keeps ten digits, and geometry is linear over such a step
constexpr int kModesBeyond = 3;  ///< modes solved for above the last known one, so that the known ones converge

VectorXd quadratic_forms(const linalg::SparseMatrix& lower, const MatrixXd& shapes) {
  return shapes.cwiseProduct(linalg::symmetric_product(lower, shapes)).colwise().sum();
}

}  // namespace

double mass_of_groups(const fe::Model& model, const std::vector<std::string>& groups) {
  const auto belongs = [&](const std::string& group) {
    return std::ranges::any_of(groups, [&](const std::string& begin) { return group.starts_with(begin); });
  };
  double sum = 0.0;
  for (const fe::Element& element : model.elements)
    if (belongs(element.group)) sum += vertical_mass(fe::element_mass(model, element));
  for (const fe::PointMass& mass : model.masses)
    if (belongs(mass.group)) sum += mass.mass_kg;
  return sum;
}

StructureAnswer static_answer(const fe::Model& model, const fe::PrestressState& state, const StructureData& data) {
  StructureAnswer out;
  out.status = state.status;
  out.force_N.resize(std::ssize(data.forces));
  for (Index i = 0; i < out.force_N.size(); ++i)
    out.force_N[i] = state.stay_pull_N[stay_position(model, data.forces[static_cast<std::size_t>(i)].stay)];
  out.mass_kg_m.resize(std::ssize(data.masses));
  for (Index i = 0; i < out.mass_kg_m.size(); ++i) {
    const KnownMass& known = data.masses[static_cast<std::size_t>(i)];
    out.mass_kg_m[i] = mass_of_groups(model, known.groups) / known.length_m;
    if (out.mass_kg_m[i] == 0.0)
      throw InputError({model.source, 0, known.name}, "names groups that no part with mass of the model belongs to",
                       "give the beginnings of names of groups of the model");
  }
  if (data.limits.empty()) return out;
  std::vector<double> vertical;
  for (const auto& condition : model.prestress.conditions)
    if (condition.dof == 2) vertical.push_back(state.displacement[6 * condition.node + condition.dof]);
  out.displacement_m = Eigen::Map<const VectorXd>(vertical.data(), std::ssize(vertical));
  return out;
}

std::vector<DataKind> kinds_of_rows(const StructureData& data, Index n_anchors) {
  std::vector<DataKind> out(data.frequencies.modes.size(), DataKind::frequency);
  out.insert(out.end(), data.forces.size(), DataKind::cable_force);
  out.insert(out.end(), data.masses.size(), DataKind::mass);
  if (!data.limits.empty()) out.insert(out.end(), static_cast<std::size_t>(n_anchors), DataKind::displacement);
  return out;
}

VectorXd deviations(const StructureAnswer& answer, const StructureData& data) {
  Rows rows(answer.frequency_Hz.size() + answer.force_N.size() + answer.mass_kg_m.size() + answer.displacement_m.size());
  const KnownFrequencies& known = data.frequencies;
  for (Index i = 0; i < answer.frequency_Hz.size(); ++i)
    rows.add((answer.frequency_Hz[i] / known.frequency_Hz[i] - 1.0) / known.std);
  for (Index i = 0; i < answer.force_N.size(); ++i) {
    const KnownForce& force = data.forces[static_cast<std::size_t>(i)];
    rows.add((answer.force_N[i] - force.force_N) / force.std_N);
  }
  for (Index i = 0; i < answer.mass_kg_m.size(); ++i) {
    const KnownMass& mass = data.masses[static_cast<std::size_t>(i)];
    rows.add((answer.mass_kg_m[i] - mass.mass_kg_m) / mass.std_kg_m);
  }
  for (const double w : answer.displacement_m)
    rows.add(std::max(0.0, std::abs(w) - data.limits.front().limit_m) / data.limits.front().std_m);
  return rows.row;
}

VectorXd deviation_changes(const StructureAnswer& answer, const StructureAnswer& change, const StructureData& data) {
  Rows rows(answer.frequency_Hz.size() + answer.force_N.size() + answer.mass_kg_m.size() + answer.displacement_m.size());
  const KnownFrequencies& known = data.frequencies;
  for (Index i = 0; i < answer.frequency_Hz.size(); ++i) rows.add(change.frequency_Hz[i] / known.frequency_Hz[i] / known.std);
  for (Index i = 0; i < answer.force_N.size(); ++i)
    rows.add(change.force_N[i] / data.forces[static_cast<std::size_t>(i)].std_N);
  for (Index i = 0; i < answer.mass_kg_m.size(); ++i)
    rows.add(change.mass_kg_m[i] / data.masses[static_cast<std::size_t>(i)].std_kg_m);
  for (Index i = 0; i < answer.displacement_m.size(); ++i) {
    const DisplacementLimit& limit = data.limits.front();
    const double w = answer.displacement_m[i];
    const double outwards = w > limit.limit_m ? 1.0 : w < -limit.limit_m ? -1.0 : 0.0;
    rows.add(outwards * change.displacement_m[i] / limit.std_m);
  }
  return rows.row;
}

struct StructureFit::Solved {
  fe::PrestressState state;
  VectorXd eigenvalue;  ///< of the known modes
  MatrixXd shapes;
  VectorXd stiffness_form, mass_form;  ///< phi' K phi, phi' M phi
  StructureAnswer answer;              ///< as this mesh has it
};

StructureFit::StructureFit(const std::vector<FittedStructure>& structures, FitObjective objective)
    : structures_(structures), objective_(std::move(objective)) {
  Index n = 0;
  for (const FittedStructure& structure : structures) n += std::ssize(structure.data.frequencies.modes);
  ratio = VectorXd::Ones(n);
}

StructureFit::Solved StructureFit::solve(const VectorXd& part, std::size_t s) const {
  const StructureData& data = structures_[s].data;
  const fe::Structure structure(structures_[s].model(part));
  Solved out;
  out.state = structure.prestress(fe::initial_parameters(structure.model()));
  out.answer = static_answer(structure.model(), out.state, data);
  if (!out.answer.status.converged || data.frequencies.modes.empty()) return out;
  const fe::ParametricSystem system = structure.system(out.state);
  const VectorXd theta = system.initial();
  dynamics::ModalSolver solver(system);
  const std::vector<int>& known = data.frequencies.modes;
  const int last = *std::max_element(known.begin(), known.end());
  const dynamics::EigenModes modes = solver.solve_available(theta, last + kModesBeyond);
  out.answer.status = modes.status;
  if (modes.frequency_Hz.size() < last) out.answer.status = {false, "the structure has fewer modes than are known"};
  if (!out.answer.status.converged) return out;
  std::vector<Index> at;
  for (const int mode : known) at.push_back(mode - 1);
  out.eigenvalue = modes.eigenvalue(at);
  out.answer.frequency_Hz = modes.frequency_Hz(at);
  out.shapes = modes.shapes(Eigen::all, at);
  out.stiffness_form = quadratic_forms(system.stiffness(theta), out.shapes);
  out.mass_form = quadratic_forms(system.mass(theta), out.shapes);
  return out;
}

VectorXd StructureFit::weights(std::size_t s) const {
  const std::vector<DataKind> kinds = kinds_of_rows(structures_[s].data, answers_[s].displacement_m.size());
  VectorXd out(std::ssize(kinds));
  for (Index i = 0; i < out.size(); ++i)
    out[i] = objective_.unit * objective_.weight[static_cast<std::size_t>(kinds[static_cast<std::size_t>(i)])];
  return out;
}

bool StructureFit::residual(const VectorXd& part, VectorXd& r) {
  std::vector<std::shared_ptr<const Solved>> solved(structures_.size());
  parallel_for(std::ssize(solved), [&](Index s) {
    solved[static_cast<std::size_t>(s)] = std::make_shared<const Solved>(solve(part, static_cast<std::size_t>(s)));
  });
  solved_ = std::move(solved);
  answers_.clear();
  std::vector<double> rows;
  Index before = 0;
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    answers_.push_back(solved_[s]->answer);
    StructureAnswer& answer = answers_.back();
    if (!answer.status.converged) return false;
    answer.frequency_Hz.array() *= ratio.segment(before, answer.frequency_Hz.size()).array();
    before += answer.frequency_Hz.size();
    const VectorXd weighted = weights(s).cwiseProduct(deviations(answer, structures_[s].data));
    rows.insert(rows.end(), weighted.begin(), weighted.end());
  }
  from_start_ = objective_.range_costs * (part - objective_.start);
  rows.insert(rows.end(), from_start_.begin(), from_start_.end());
  r = Eigen::Map<const VectorXd>(rows.data(), std::ssize(rows));
  return true;
}

bool StructureFit::needs_statics() const {
  return objective_.weight[static_cast<std::size_t>(DataKind::cable_force)] > 0.0 ||
         objective_.weight[static_cast<std::size_t>(DataKind::displacement)] > 0.0;
}

StructureAnswer StructureFit::change(const VectorXd& part, Index size, std::size_t s) const {
  const Solved& at = *solved_[s];
  const StructureData& data = structures_[s].data;
  // Backward difference in the upper half, so that the step stays in the range.
  const double h = part[size] > 0.5 ? -kRangeStep : kRangeStep;
  VectorXd moved = part;
  moved[size] += h;
  const fe::Structure structure(structures_[s].model(moved));
  const fe::ParametricSystem system = structure.system(at.state);
  const VectorXd theta = system.initial();
  const bool follow = needs_statics() && (!data.forces.empty() || !data.limits.empty());
  StructureAnswer out = static_answer(structure.model(), follow ? structure.prestress(theta) : at.state, data);
  out.force_N = (out.force_N - at.answer.force_N) / h;
  out.mass_kg_m = (out.mass_kg_m - at.answer.mass_kg_m) / h;
  out.displacement_m = (out.displacement_m - at.answer.displacement_m) / h;
  if (at.eigenvalue.size() == 0) return out;
  const VectorXd dk = quadratic_forms(system.stiffness(theta), at.shapes) - at.stiffness_form;
  const VectorXd dm = quadratic_forms(system.mass(theta), at.shapes) - at.mass_form;
  // f = sqrt(lambda) / (2 pi), so df = f / (2 lambda) dlambda.
  out.frequency_Hz =
      0.5 / h * answers_[s].frequency_Hz.array() / at.eigenvalue.array() * (dk.array() - at.eigenvalue.array() * dm.array());
  return out;
}

MatrixXd StructureFit::jacobian(const VectorXd& part) const {
  const Index n_structures = std::ssize(structures_);
  std::vector<Index> first = {0};
  std::vector<VectorXd> weight;
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    weight.push_back(weights(s));
    first.push_back(first.back() + weight.back().size());
  }
  MatrixXd j = MatrixXd::Zero(first.back() + part.size(), part.size());
  j.bottomRows(part.size()).diagonal().setConstant(objective_.range_costs);
  parallel_for(part.size() * n_structures, [&](Index work) {
    const Index v = work / n_structures;
    const auto s = static_cast<std::size_t>(work % n_structures);
    if (structures_[s].acts && !structures_[s].acts(v)) return;
    const VectorXd changes = deviation_changes(answers_[s], change(part, v, s), structures_[s].data);
    j.col(v).segment(first[s], changes.size()) = weight[s].cwiseProduct(changes);
  });
  return j;
}

VectorXd StructureFit::frequencies() const {
  VectorXd out(ratio.size());
  Index filled = 0;
  for (const StructureAnswer& answer : answers_) {
    out.segment(filled, answer.frequency_Hz.size()) = answer.frequency_Hz;
    filled += answer.frequency_Hz.size();
  }
  return out;
}

std::array<double, n_data_kinds + 1> StructureFit::costs() const {
  std::array<double, n_data_kinds + 1> out{};
  for (std::size_t s = 0; s < answers_.size(); ++s) {
    const std::vector<DataKind> kinds = kinds_of_rows(structures_[s].data, answers_[s].displacement_m.size());
    const VectorXd row = weights(s).cwiseProduct(deviations(answers_[s], structures_[s].data));
    for (std::size_t i = 0; i < kinds.size(); ++i)
      out[static_cast<std::size_t>(kinds[i])] += 0.5 * row[static_cast<Index>(i)] * row[static_cast<Index>(i)];
  }
  out.back() = 0.5 * from_start_.squaredNorm();
  return out;
}

FitSearch search_fit(StructureFit& fit, VectorXd part, int max_iterations,
                     const std::function<void(const FitSearch&)>& report) {
  constexpr double settled_change = 1e-4;  // [-] of the cost: far below what a thousandth of any standard deviation changes
  constexpr double inside = 1e-9;          // [-] part of a range that still counts as on its edge
  const Box box{VectorXd::Zero(part.size()), VectorXd::Ones(part.size())};
  FitSearch out{std::move(part)};
  VectorXd r;
  if (!fit.residual(out.part, r)) return out;
  double damping = 1e-4;
  for (; out.iterations < max_iterations; ++out.iterations) {
    const double cost = 0.5 * r.squaredNorm();
    const MatrixXd j = fit.jacobian(out.part);
    out.projected_gradient = projected_gradient(out.part, j.transpose() * r, box, inside).norm();
    report(out);
    VectorXd r_next;
    bool lower = false;
    for (int tries = 0; tries < 6 && !lower; ++tries) {
      const VectorXd step = bounded_gauss_newton_step(r, j, out.part, box, damping);
      const VectorXd next = (out.part + step).cwiseMax(0.0).cwiseMin(1.0);
      lower = fit.residual(next, r_next) && 0.5 * r_next.squaredNorm() < cost;
      if (lower) out.part = next;
      damping = lower ? std::max(1e-9, damping / 5.0) : damping * 8.0;
    }
    // No step lowers the cost: rounding is reached, or modes change places.
    out.settled = !lower || cost - 0.5 * r_next.squaredNorm() < settled_change * cost;
    if (lower) r = r_next;
    if (out.settled) break;
  }
  // The last computed residual may be that of a refused step.
  static_cast<void>(fit.residual(out.part, r));
  return out;
}

}  // namespace twindeck::updating
