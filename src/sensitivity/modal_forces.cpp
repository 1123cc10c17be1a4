#include "sensitivity/modal_forces.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/free_structure.hpp"
#include "linalg/dense.hpp"

namespace twindeck::sensitivity {

ModalForces modal_forces(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, const dynamics::EigenModes& modes,
                         int parameter, double cluster_gap) {
  const Eigen::MatrixXd& phi = modes.shapes;
  const Eigen::VectorXd& lambda = modes.eigenvalue;
  const Eigen::MatrixXd d_mass_phi = system.mass_derivative_times(theta, parameter, phi);
  ModalForces out;
  out.force = -system.stiffness_derivative_times(theta, parameter, phi);
  out.force.noalias() += d_mass_phi * lambda.asDiagonal();
  const Eigen::MatrixXd modal_force = linalg::product(phi, out.force, true),
                        modal_mass = linalg::product(phi, d_mass_phi, true);
  out.along.resize(phi.cols(), phi.cols());
  for (Eigen::Index i = 0; i < phi.cols(); ++i) {
    for (Eigen::Index j = 0; j < phi.cols(); ++j) {
      const double gap = lambda[j] - lambda[i];
      const bool together = i == j || std::abs(gap) <= cluster_gap * std::max(std::abs(lambda[i]), std::abs(lambda[j]));
      out.along(j, i) = together ? -0.5 * modal_mass(j, i) : modal_force(j, i) / gap;
    }
  }
  return out;
}

double factorize_shifted(linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass, linalg::Cholesky& factor) {
  if (factor.factorize(stiffness).converged) return 0.0;
  const double shift = dynamics::free_structure_shift(stiffness, mass);
  stiffness = stiffness - shift * mass;
  stiffness.makeCompressed();
  const Status status = factor.factorize(stiffness);
  TWINDECK_ASSERT(status.converged);  // the modes were solved for with this very matrix
  return shift;
}

}  // namespace twindeck::sensitivity
