#include "fe/cable.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double force_range =
    4.0;                        ///< [-] the force is looked for within this factor of the taut string's, which sag never leaves
constexpr int force_scan = 48;  ///< forces that are tried first: with sag the misfit has several minima
constexpr int force_cuts = 50;  ///< golden sections: 0.618^50 of the range is below rounding

double mass_per_length(const Model& model, const Element& stay) {
  return material_of(model, stay).density_kg_m3 * section_of(model, stay).area_m2;
}

/// Nodes of the chain from end to end (pieces + 1).
std::vector<Vector3d> hanging(const Model& model, const Element& stay, double force_N, int pieces) {
  const auto ends = end_nodes(model, stay);
  const double length = (ends[1] - ends[0]).norm();
  const double sag = mass_per_length(model, stay) * model.gravity_m_s2 * length * length / (8.0 * force_N);
  std::vector<Vector3d> nodes;
  for (int i = 0; i <= pieces; ++i) {
    const double xi = static_cast<double>(i) / pieces;
    nodes.emplace_back(ends[0] + xi * (ends[1] - ends[0]) - 4.0 * sag * xi * (1.0 - xi) * Vector3d::UnitZ());
  }
  return nodes;
}

/// Nodes of one chain, ends included; adds those between.
std::vector<int> hang(Model& model, const Element& stay, double pull_N, int pieces, long& next_id) {
  const std::vector<Vector3d> x_m = hanging(model, stay, pull_N, pieces);
  std::vector<int> nodes = {stay.nodes[0]};
  for (std::size_t k = 1; k + 1 < x_m.size(); ++k) {
    nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back({next_id++, x_m[k]});
  }
  nodes.push_back(stay.nodes[1]);
  return nodes;
}

}  // namespace

Cable cable_beyond_bar(const Model& model, const Element& stay, double force_N, int pieces) {
  TWINDECK_ASSERT(pieces >= 2 && stay.type == ElementType::stay);
  if (!(force_N > 0.0))
    throw InputError({model.source, 0, stay.name}, "has no force, a cable of it would not hang",
                     "give its pull in elements.csv and a rule of prestress in model.toml");
  const std::vector<Vector3d> nodes = hanging(model, stay, force_N, pieces);
  const double modulus = material_of(model, stay).youngs_modulus_Pa, area = section_of(model, stay).area_m2;
  const Index n = 3 * (pieces + 1);
  Cable cable{{nodes.begin() + 1, nodes.end() - 1}, MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  const auto place = [&](int node) { return node == 0 ? Index{0} : node == pieces ? Index{3} : Index{3 + 3 * node}; };
  for (int i = 0; i < pieces; ++i) {
    const std::array<Vector3d, 2> ends = {nodes[static_cast<std::size_t>(i)], nodes[static_cast<std::size_t>(i) + 1]};
    const double m = mass_per_length(model, stay);
    const Matrix6 k = bar_stiffness(ends, modulus, area) + string_stiffness(ends, force_N);
    const Matrix6 mass = 0.5 * (bar_mass_consistent(ends, m) + bar_mass_lumped(ends, m));
    const std::array<Index, 2> at = {place(i), place(i + 1)};
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 0; b < 2; ++b) {
        const auto row = static_cast<Index>(3 * a), column = static_cast<Index>(3 * b);
        cable.stiffness.block<3, 3>(at[a], at[b]) += k.block<3, 3>(row, column);
        cable.mass.block<3, 3>(at[a], at[b]) += mass.block<3, 3>(row, column);
      }
  }
  const Index inner = n - 6;
  const MatrixXd coupling = cable.stiffness.bottomLeftCorner(inner, 6);
  const MatrixXd inner_stiffness = cable.stiffness.bottomRightCorner(inner, inner);
  // What is left of the ends' block once the inner nodes follow statically is the bar's.
  cable.stiffness.topLeftCorner<6, 6>() = coupling.transpose() * inner_stiffness.llt().solve(coupling);
  cable.mass.topLeftCorner<6, 6>() -= element_mass(model, stay).matrix;
  return cable;
}

Eigen::VectorXd in_plane_frequencies(const Model& model, const Element& stay, const Cable& cable) {
  const auto ends = end_nodes(model, stay);
  const Vector3d along = (ends[1] - ends[0]).normalized();
  Vector3d across = Vector3d::UnitZ() - along.z() * along;
  if (across.norm() < 1e-6) across = along.unitOrthogonal();  // a vertical stay has no sag: every plane is alike
  across.normalize();
  const auto n = static_cast<Index>(cable.inner_x_m.size());
  MatrixXd plane = MatrixXd::Zero(3 * n, 2 * n);
  for (Index i = 0; i < n; ++i) plane.block<3, 2>(3 * i, 2 * i) << along, across;
  const MatrixXd k = plane.transpose() * cable.stiffness.bottomRightCorner(3 * n, 3 * n) * plane;
  const MatrixXd m = plane.transpose() * cable.mass.bottomRightCorner(3 * n, 3 * n) * plane;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, m, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  return solver.eigenvalues().head((n + 1) / 2).cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

double force_of_harmonics(const Model& model, const Element& stay, const std::vector<StayHarmonic>& harmonics, int pieces) {
  const auto ends = end_nodes(model, stay);
  const double length = (ends[1] - ends[0]).norm();
  double sum = 0.0;
  int used = 0;
  for (const StayHarmonic& h : harmonics) {
    if (h.number > pieces / 2) continue;
    sum += std::log(h.frequency_Hz / h.number);
    ++used;
  }
  if (used == 0) return 0.0;
  const double string = mass_per_length(model, stay) * std::pow(2.0 * length * std::exp(sum / used), 2);
  const auto misfit = [&](double log_force) {
    const double force = std::exp(log_force);
    const Eigen::VectorXd f = in_plane_frequencies(model, stay, cable_beyond_bar(model, stay, force, pieces));
    double out = 0.0;
    for (const StayHarmonic& h : harmonics)
      if (h.number <= pieces / 2) out += std::pow(std::log(f[h.number - 1] / h.frequency_Hz) / h.relative_std, 2);
    return out;
  };
  const double cut = 0.5 * (std::sqrt(5.0) - 1.0);
  // The least misfit of a scan, from the tautest cable down; the golden sections then stay beside it.
  const double tautest = std::log(string * force_range), pace = 2.0 * std::log(force_range) / force_scan;
  double best = tautest, least = misfit(tautest);
  for (int i = 1; i <= force_scan; ++i)
    if (const double here = misfit(tautest - i * pace); here < least) best = tautest - i * pace, least = here;
  double low = best - pace, high = best + pace;
  for (int i = 0; i < force_cuts; ++i) {
    const double a = high - cut * (high - low), b = low + cut * (high - low);
    (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
  }
  return std::exp(0.5 * (low + high));
}

std::string stay_name(const Element& stay) { return stay.name.empty() ? std::to_string(stay.id) : stay.name; }

Model with_swinging_stays(Model model, const std::vector<SwingingStay>& stays, int pieces) {
  constexpr long million = 1000000;
  long id = 0;
  for (const Node& node : model.nodes) id = std::max(id, node.id);
  id = (id / million + 1) * million;
  for (const SwingingStay& swinging : stays) {
    TWINDECK_ASSERT(swinging.element >= 0 && swinging.element < std::ssize(model.elements));
    const Element stay = model.elements[static_cast<std::size_t>(swinging.element)];
    const Cable cable = cable_beyond_bar(model, stay, swinging.force_N, pieces);
    MatrixElement element;
    element.name = "cable_" + stay_name(stay);
    element.group = "cables";
    std::vector<int> nodes = stay.nodes;
    for (const Eigen::Vector3d& x : cable.inner_x_m) {
      nodes.push_back(static_cast<int>(model.nodes.size()));
      model.nodes.push_back({id++, x});
    }
    for (const int node : nodes)
      for (int d = 0; d < 3; ++d) element.dofs.push_back({node, d});
    element.stiffness = cable.stiffness;
    element.mass = cable.mass;
    model.matrix_elements.push_back(std::move(element));
  }
  return model;
}

StayChains with_stay_chains(const Model& model, const PrestressState& state, int pieces,
                            const std::vector<std::string>& names) {
  TWINDECK_ASSERT(pieces >= 2 && state.stay_pull_N.size() == std::ssize(model.elements));
  StayChains out{model, state, {}};
  long node_id = 0, element_id = 0;
  for (const Node& node : model.nodes) node_id = std::max(node_id, node.id + 1);
  for (const Element& element : model.elements) element_id = std::max(element_id, element.id + 1);
  std::vector<Element> added;
  std::vector<double> pull_of_added;
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const Element& stay = model.elements[i];
    if (stay.type != ElementType::stay || !contains(names, stay.name)) continue;
    const double pull = state.stay_pull_N[static_cast<Eigen::Index>(i)];
    if (pull <= 0.0)
      throw InputError({model.source, 0, stay.name}, "has no pull, a chain of it would not hang", "give the model a prestress");
    const std::vector<int> nodes = hang(out.model, stay, pull, pieces, node_id);
    out.nodes[stay.name] = nodes;
    out.model.elements[i].nodes = {nodes[0], nodes[1]};
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
      Element piece = stay;
      piece.id = element_id++;
      piece.name = stay.name + "." + std::to_string(k + 1);
      piece.nodes = {nodes[k], nodes[k + 1]};
      added.push_back(piece);
      pull_of_added.push_back(pull);
    }
  }
  for (const std::string& name : names)
    if (!out.nodes.contains(name))
      throw InputError({model.source, 0, "stays"}, "'" + name + "' is no stay of the model", "name stays such as NE8");
  const Eigen::Index n_before = state.stay_pull_N.size(), n_added = std::ssize(added);
  out.model.elements.insert(out.model.elements.end(), added.begin(), added.end());
  out.state.stay_pull_N.conservativeResize(n_before + n_added);
  out.state.axial_force_N.conservativeResize(n_before + n_added);
  for (Eigen::Index k = 0; k < n_added; ++k) {
    out.state.stay_pull_N[n_before + k] = pull_of_added[static_cast<std::size_t>(k)];
    out.state.axial_force_N[n_before + k] = 0.0;
  }
  return out;
}

}  // namespace twindeck::fe
