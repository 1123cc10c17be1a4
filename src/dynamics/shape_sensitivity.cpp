#include <cmath>
#include <utility>
#include <vector>

#include "dynamics/eigen_sensitivity.hpp"
#include "dynamics/free_structure.hpp"

namespace twindeck::dynamics {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTolerance = 1e-11;  ///< of the residual in the energy norm, relative to the right-hand side's
constexpr int kMaxIterations = 300;   ///< far above what distinct eigenvalues need (ten to thirty)

VectorXd column_dots(const MatrixXd& a, const MatrixXd& b) { return a.cwiseProduct(b).colwise().sum(); }

/// Solves (K - lambda_i M) z_i = f_i outside the span of the modes, all columns at once, each with its own scalars.
MatrixXd solve_outside_modes(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass, const VectorXd& lambda,
                             const MatrixXd& shapes, const MatrixXd& mass_shapes, const linalg::Cholesky& factor,
                             MatrixXd residual) {
  const auto precondition = [&](const MatrixXd& r) {
    MatrixXd y = factor.solve(r);
    y -= shapes * (mass_shapes.transpose() * y);  // exact already but for rounding, which would grow along the modes
    return y;
  };
  residual -= mass_shapes * (shapes.transpose() * residual);
  MatrixXd z = MatrixXd::Zero(residual.rows(), residual.cols());
  MatrixXd preconditioned = precondition(residual), direction = preconditioned;
  VectorXd energy = column_dots(residual, preconditioned);
  const VectorXd floor = kTolerance * kTolerance * energy;
  for (int iteration = 0; iteration < kMaxIterations && (energy.array() > floor.array()).any(); ++iteration) {
    const MatrixXd image = MatrixXd(stiffness.selfadjointView<Eigen::Lower>() * direction) -
                           MatrixXd(mass.selfadjointView<Eigen::Lower>() * direction) * lambda.asDiagonal();
    const VectorXd curvature = column_dots(direction, image);
    VectorXd step(energy.size());
    for (Index i = 0; i < step.size(); ++i)
      step[i] = energy[i] > floor[i] && curvature[i] > 0.0 ? energy[i] / curvature[i] : 0.0;
    z += direction * step.asDiagonal();
    residual -= image * step.asDiagonal();
    preconditioned = precondition(residual);
    const VectorXd next = column_dots(residual, preconditioned);
    VectorXd turn(energy.size());
    for (Index i = 0; i < turn.size(); ++i) turn[i] = energy[i] > floor[i] ? next[i] / energy[i] : 0.0;
    direction = preconditioned + direction * turn.asDiagonal();
    for (Index i = 0; i < energy.size(); ++i) energy[i] = energy[i] > floor[i] ? next[i] : energy[i];
    if (step.isZero(0.0)) break;
  }
  return z;
}

}  // namespace

ShapeSensitivity::ShapeSensitivity(const fe::ParametricSystem& system, VectorXd theta, EigenModes modes, double cluster_gap)
    : system_(system),
      theta_(std::move(theta)),
      modes_(std::move(modes)),
      cluster_gap_(cluster_gap),
      stiffness_(system.stiffness(theta_)),
      mass_(system.mass(theta_)) {
  if (!factor_.factorize(stiffness_).converged) {
    linalg::SparseMatrix shifted = stiffness_ - free_structure_shift(stiffness_, mass_) * mass_;
    shifted.makeCompressed();
    const Status status = factor_.factorize(shifted);
    TWINDECK_ASSERT(status.converged);  // the modes were solved for with this very matrix
  }
  mass_shapes_ = mass_.selfadjointView<Eigen::Lower>() * modes_.shapes;
}

MatrixXd ShapeSensitivity::derivative(int parameter) const {
  const MatrixXd& phi = modes_.shapes;
  const VectorXd& lambda = modes_.eigenvalue;
  const MatrixXd d_mass_phi = system_.mass_derivative_times(theta_, parameter, phi);
  // -(dK - lambda_i dM) phi_i; the term of dlambda_i lies along M phi_i and is projected off.
  const MatrixXd force = d_mass_phi * lambda.asDiagonal() - system_.stiffness_derivative_times(theta_, parameter, phi);
  const MatrixXd modal_force = phi.transpose() * force, modal_mass = phi.transpose() * d_mass_phi;

  MatrixXd c(phi.cols(), phi.cols());  // parts along the modes: column i of the derivative of mode i
  for (Index i = 0; i < phi.cols(); ++i) {
    for (Index j = 0; j < phi.cols(); ++j) {
      const double gap = lambda[j] - lambda[i];
      const bool together = i == j || std::abs(gap) <= cluster_gap_ * std::max(std::abs(lambda[i]), std::abs(lambda[j]));
      c(j, i) = together ? -0.5 * modal_mass(j, i) : modal_force(j, i) / gap;
    }
  }
  return phi * c + solve_outside_modes(stiffness_, mass_, lambda, phi, mass_shapes_, factor_, force);
}

MatrixXd shape_derivative(const fe::ParametricSystem& system, const VectorXd& theta, const EigenModes& modes, int parameter) {
  return ShapeSensitivity(system, theta, modes).derivative(parameter);
}

}  // namespace twindeck::dynamics
