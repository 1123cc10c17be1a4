#include "updating/structure_data.hpp"

#include <algorithm>
#include <cmath>

#include "fe/assembly_elements.hpp"

namespace twindeck::updating {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Mass that a small matrix gives to a movement upwards of all its nodes.
double vertical_mass(const fe::ElementMatrix& mass) {
  double sum = 0.0;
  for (std::size_t j = 0; j < mass.dofs.size(); ++j) {
    for (std::size_t i = 0; i < mass.dofs.size(); ++i) {
      if (mass.dofs[i] % 6 == 2 && mass.dofs[j] % 6 == 2) sum += mass.matrix(static_cast<Index>(i), static_cast<Index>(j));
    }
  }
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

/// Rows one after another.
struct Rows {
  VectorXd row;
  Index filled = 0;
  explicit Rows(Index n) : row(n) {}
  void add(double value) { row[filled++] = value; }
};

}  // namespace

double mass_of_groups(const fe::Model& model, const std::vector<std::string>& groups) {
  const auto belongs = [&](const std::string& group) {
    return std::any_of(groups.begin(), groups.end(), [&](const std::string& begin) { return group.starts_with(begin); });
  };
  double sum = 0.0;
  for (const fe::Element& element : model.elements) {
    if (belongs(element.group)) sum += vertical_mass(fe::element_mass(model, element));
  }
  for (const fe::PointMass& mass : model.masses) {
    if (belongs(mass.group)) sum += mass.mass_kg;
  }
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
    if (out.mass_kg_m[i] == 0.0) {
      throw InputError({model.source, 0, known.name}, "names groups that no part with mass of the model belongs to",
                       "give the beginnings of names of groups of the model");
    }
  }
  if (data.limits.empty()) return out;
  std::vector<double> vertical;
  for (const auto& condition : model.prestress.conditions) {
    if (condition.dof == 2) vertical.push_back(state.displacement[6 * condition.node + condition.dof]);
  }
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

}  // namespace twindeck::updating
