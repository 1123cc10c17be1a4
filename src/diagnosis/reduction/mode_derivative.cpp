#include "diagnosis/reduction/mode_derivative.hpp"

#include <Eigen/Dense>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

ModeDerivative differentiate(const StructureState& state, const StateModes& modes, Index mode, const MatrixXcd& force) {
  const Complex s = modes.s[mode];
  const VectorXcd phi = modes.shapes.col(mode);
  const Index n = phi.size(), changes = force.cols();
  const VectorXd re = phi.real();
  MatrixXcd right = MatrixXcd::Zero(n + 1, changes);
  right.topRows(n) = force;
  MatrixXcd t;
  VectorXcd t_prime_phi;
  dynamic_matrices(state, s, phi, t, t_prime_phi);
  ModeDerivative out;
  if (!state.damped()) {  // everything is real in lambda = -s²: (K - lambda M) dphi - dlambda M phi = -(dK - lambda dM) phi
    MatrixXd bordered(n + 1, n + 1);
    bordered << t.real(), -(state.mass * re), -(state.mass * re).transpose(), 0.0;
    const MatrixXd solution = linalg::solve(std::move(bordered), MatrixXd(right.real()));
    out.shapes = solution.topRows(n).cast<Complex>();
    const double omega = s.imag();
    out.s.resize(changes);
    for (Index j = 0; j < changes; ++j) out.s[j] = Complex(0.0, omega > 0.0 ? solution(n, j) / (2.0 * omega) : 0.0);
    return out;
  }
  MatrixXcd bordered(n + 1, n + 1);
  bordered.topLeftCorner(n, n) = t;
  bordered.topRightCorner(n, 1) = t_prime_phi;
  bordered.bottomLeftCorner(1, n) = t_prime_phi.transpose();
  bordered(n, n) = 0.0;
  const MatrixXcd solution = linalg::solve(std::move(bordered), std::move(right));
  out.shapes = solution.topRows(n);
  out.s = solution.row(n).transpose();
  return out;
}

VectorXcd along_the_shape(const StructureState& state, const StateModes& modes, Index mode, const VectorXcd& ds,
                          const MatrixXcd& inertia) {
  const VectorXcd phi = modes.shapes.col(mode);
  const VectorXcd own = inertia.transpose() * phi;  // phi' dM phi
  if (!state.damped()) return -0.5 * own;
  // 2 phi' T' dphi + phi' (T'' ds + 2 s dM) phi = 2 ds, with dphi = along phi
  const Complex s = modes.s[mode];
  Complex bend = 2.0 * (phi.transpose() * (state.mass * phi))(0);  // phi' T'' phi
  for (const Attachment& a : state.attachments) {
    const Complex stroke = a.direction.cast<Complex>().dot(phi);
    bend += second_derivative(a, s) * stroke * stroke;
  }
  return ((2.0 - bend) * ds - 2.0 * s * own) / (4.0 * s);
}

}  // namespace twindeck::diagnosis
