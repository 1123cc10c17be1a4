#include "dynamics/eigenmodes.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "linalg/generalized_eigen.hpp"

namespace twindeck::dynamics {

double free_structure_shift(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass) {
  const Eigen::VectorXd k = stiffness.diagonal(), m = mass.diagonal();
  double least = 0.0;
  for (Eigen::Index i = 0; i < k.size(); ++i)
    if (m[i] > 0.0 && k[i] > 0.0 && (least == 0.0 || k[i] / m[i] < least)) least = k[i] / m[i];
  return -1e-4 * least;
}

ModalSolver::ModalSolver(const fe::ParametricSystem& system) : system_(system) {}

EigenModes ModalSolver::solve(const Eigen::VectorXd& theta, int n_modes) {
  const linalg::SparseMatrix stiffness = system_.stiffness(theta);
  mass_ = system_.mass(theta);
  linalg::EigenPairs pairs = linalg::lowest_eigenpairs(stiffness, mass_, n_modes, 0.0, factor_);
  if (factor_.failed_column() >= 0) {
    const double shift = free_structure_shift(stiffness, mass_);
    if (shift < 0.0) {
      linalg::EigenPairs shifted = linalg::lowest_eigenpairs(stiffness, mass_, n_modes, shift, factor_);
      // Where the shift does not help either (a mechanism without mass, a negative stiffness), the first message is the
      // clearer.
      if (shifted.values.size() > 0) pairs = std::move(shifted);
    }
  }
  EigenModes modes;
  modes.status = pairs.status;
  modes.eigenvalue = pairs.values;
  modes.frequency_Hz = pairs.values.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
  modes.shapes = std::move(pairs.vectors);
  return modes;
}

EigenModes ModalSolver::solve_available(const Eigen::VectorXd& theta, int n_modes) {
  EigenModes modes = solve(theta, std::min(n_modes, static_cast<int>(system_.size())));
  const auto found = static_cast<int>(modes.frequency_Hz.size());
  if (!modes.status.converged && found > 0 && found < n_modes) modes = solve(theta, found);
  return modes;
}

}  // namespace twindeck::dynamics
