#include "diagnosis/reduction/basis_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "diagnosis/reduction/reduction_options.hpp"
#include "dynamics/eigenmodes.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;

/// Times the highest measured frequency. A cause or parameter may lower a mode by a third, for example a factor 0.44 on
/// stiffness, so modes from above can enter the measured band. Modes above the band also represent part of the errors of static
/// vectors within it.
constexpr double kReach = 1.5;

/// Most modes of a basis, as for the setting `modes`. The time of a search grows with the third power of the size.
constexpr int kMostModes = 200;

double highest_measured(const FeatureSet& features) {
  double highest = 0.0;
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency) highest = std::max(highest, row.value);
  return highest;
}

int count_up_to(const Eigen::VectorXd& ascending_Hz, double highest_Hz) {
  return static_cast<int>((ascending_Hz.array() <= highest_Hz).count());
}

/// Shortest wavelength of some modes, from the displacements of the elements' ends and their differences. Elements whose ends
/// depend on other nodes are skipped. @param shapes  (n_dofs × n_modes)
double shortest_wave_m(const Structure& structure, const Eigen::MatrixXd& shapes) {
  if (structure.model == nullptr || shapes.cols() == 0) return 0.0;
  std::map<std::string, std::vector<std::pair<int, Index>>> rows;  // direction and dof of each node's displacements
  for (std::size_t i = 0; i < structure.system->dofs.size(); ++i)
    if (const fe::DofLabel& dof = structure.system->dofs[i]; dof.direction < 3)
      rows[dof.node].emplace_back(dof.direction, static_cast<Index>(i));
  const auto motion = [&](int node) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3, shapes.cols());
    const auto found = rows.find(std::to_string(structure.model->nodes[static_cast<std::size_t>(node)].id));
    if (found != rows.end())
      for (const auto& [direction, dof] : found->second) out.row(direction) = shapes.row(dof);
    return out;
  };
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(shapes.cols()), slope = displacement;
  for (const fe::Element& element : structure.model->elements) {
    if (element.type == fe::ElementType::stay) continue;  // it swings by itself
    for (std::size_t k = 1; k < element.nodes.size(); ++k) {
      const int from = element.nodes[k - 1], to = element.nodes[k];
      const double length = (structure.model->nodes[static_cast<std::size_t>(to)].x_m -
                             structure.model->nodes[static_cast<std::size_t>(from)].x_m)
                                .norm();
      if (!(length > 0.0)) continue;
      const Eigen::MatrixXd first = motion(from), second = motion(to);
      displacement += 0.5 * length * (first.colwise().squaredNorm() + second.colwise().squaredNorm()).transpose();
      slope += (second - first).colwise().squaredNorm().transpose() / length;
    }
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (Index j = 0; j < shapes.cols(); ++j)
    if (slope[j] > 0.0) shortest = std::min(shortest, 2.0 * std::numbers::pi * std::sqrt(displacement[j] / slope[j]));
  return std::isfinite(shortest) ? shortest : 0.0;
}

}  // namespace

BasisModes modes_of_basis(const Structure& structure, const FeatureSet& features, int least) {
  BasisModes out{least, 0, kReach * highest_measured(features), true, {}};
  const auto dofs = static_cast<int>(structure.system->size());
  if (!(out.reach_Hz > 0.0) || dofs <= ReductionOptions{}.full_below) return out;
  const auto tell_wave = [&](const Eigen::MatrixXd& shapes) {
    const int measured = count_up_to(out.frequency_Hz, out.reach_Hz / kReach);
    out.eighth_of_wave_m = shortest_wave_m(structure, shapes.leftCols(measured)) / 8.0;
  };
  dynamics::ModalSolver solver(*structure.system);
  for (int asked = least;; asked = std::min(2 * asked, kMostModes)) {
    const dynamics::EigenModes modes = solver.solve_available(structure.theta, std::min(asked, dofs));
    out.frequency_Hz = modes.frequency_Hz;
    tell_wave(modes.shapes);
    const int inside = count_up_to(out.frequency_Hz, out.reach_Hz);
    if (inside < out.frequency_Hz.size() || out.frequency_Hz.size() < std::min(asked, dofs)) {
      out.modes = std::max(least, inside + 1);  // with the first mode above the reach
      if (out.modes > least) out.in_band = count_up_to(out.frequency_Hz, out.reach_Hz / kReach);
      return out;
    }
    if (asked >= std::min(kMostModes, dofs)) break;
  }
  out.enough = out.frequency_Hz.size() >= dofs;
  out.modes = static_cast<int>(out.frequency_Hz.size());
  return out;
}

}  // namespace twindeck::diagnosis
