#include "matching/solved_model.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "matching/pairing.hpp"
#include "modal/mac.hpp"

namespace twindeck::matching {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

bool same_dofs(const fe::ParametricSystem& a, const fe::ParametricSystem& b) {
  if (a.dofs.size() != b.dofs.size()) return false;
  for (std::size_t i = 0; i < a.dofs.size(); ++i)
    if (a.dofs[i].node != b.dofs[i].node || a.dofs[i].direction != b.dofs[i].direction || a.dofs[i].x_m != b.dofs[i].x_m)
      return false;
  return true;
}

/// Nodes by position to the nearest 0.1 mm; of several at one place the first counts.
std::map<std::array<long, 3>, Index> nodes_by_place(const fe::Model& model) {
  std::map<std::array<long, 3>, Index> at;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Eigen::Vector3d x = model.nodes[i].x_m * 1e4;
    at.try_emplace({std::lround(x[0]), std::lround(x[1]), std::lround(x[2])}, static_cast<Index>(i));
  }
  return at;
}

/// Modes whose motion at some of the rows is more than rounding.
std::vector<Index> moving_modes(const MatrixXd& shapes, const std::vector<Index>& rows) {
  std::vector<Index> moving;
  for (Index j = 0; j < shapes.cols(); ++j)
    if (shapes(rows, j).norm() > 1e-9 * shapes.col(j).cwiseAbs().maxCoeff()) moving.push_back(j);
  return moving;
}

/// MAC of two models' modes (n_a × n_b): weighted by the mass of `a` where both have the same degrees of freedom; where their
/// meshes differ, at the translations of the nodes that they have in common (the same coordinates).
MatrixXd mac_between(const SolvedModel& a, const SolvedModel& b) {
  if (same_dofs(a.loaded.system, b.loaded.system)) {
    // b is normalised with its own mass. Divided by its norm in the mass of a, the entries are squared cosines.
    const Eigen::VectorXd norm =
        b.modes.shapes.cwiseProduct(a.mass.selfadjointView<Eigen::Lower>() * b.modes.shapes).colwise().sum();
    return modal::mass_weighted_mac(a.mass_shapes, b.modes.shapes) * norm.cwiseInverse().asDiagonal();
  }
  if (!a.loaded.model || !b.loaded.model)
    throw InputError({b.loaded.source, 0, ""}, "has other degrees of freedom than " + a.loaded.source,
                     "compare models of the same degrees of freedom");
  const MatrixXd full_a = a.loaded.system.expand(a.modes.shapes), full_b = b.loaded.system.expand(b.modes.shapes);
  const auto places_b = nodes_by_place(*b.loaded.model);
  std::vector<Index> rows_a, rows_b;
  for (const auto& [place, node_a] : nodes_by_place(*a.loaded.model)) {
    const auto at = places_b.find(place);
    if (at == places_b.end()) continue;
    for (Index d = 0; d < 3; ++d) {
      rows_a.push_back(6 * node_a + d);
      rows_b.push_back(6 * at->second + d);
    }
  }
  if (rows_a.empty())
    throw InputError({b.loaded.source, 0, ""}, "has no node where " + a.loaded.source + " has one",
                     "compare models in the same coordinates");
  // A mode that only rotates at these nodes (torsion of a line of beams) has no MAC: its translations are rounding.
  const std::vector<Index> moving_a = moving_modes(full_a, rows_a), moving_b = moving_modes(full_b, rows_b);
  MatrixXd mac = MatrixXd::Zero(full_a.cols(), full_b.cols());
  const MatrixXd common_a = full_a(rows_a, moving_a), common_b = full_b(rows_b, moving_b);
  mac(moving_a, moving_b) = modal::mac(common_a, common_b);
  return mac;
}

}  // namespace

SolvedModel solve_modes(dynamics::LoadedModel loaded, int n_modes) {
  SolvedModel solved;
  solved.loaded = std::move(loaded);
  dynamics::ModalSolver solver(solved.loaded.system);
  solved.modes = solver.solve_available(solved.loaded.theta, n_modes);
  solved.mass = solver.mass();
  solved.mass_shapes = solved.mass.selfadjointView<Eigen::Lower>() * solved.modes.shapes;
  if (!solved.loaded.state.status.converged && solved.modes.status.converged) solved.modes.status = solved.loaded.state.status;
  return solved;
}

TrackedModes follow(const SolvedModel& reference, const SolvedModel& changed, Index count) {
  TWINDECK_ASSERT(count <= reference.modes.frequency_Hz.size());
  const MatrixXd likeness = mac_between(reference, changed);
  // Every mode of the reference takes part in the assignment, so that one computed mode does not serve two.
  const std::vector<int> position = matching::follow_modes(likeness);
  const Eigen::VectorXd lost = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  TrackedModes followed{lost, lost, {}};
  for (Index i = 0; i < count; ++i) {
    const int at = position[static_cast<std::size_t>(i)];
    followed.position.push_back(at);
    if (at < 0) continue;
    followed.frequency_Hz[i] = changed.modes.frequency_Hz[at];
    followed.mac[i] = likeness(i, at);
  }
  return followed;
}

}  // namespace twindeck::matching
