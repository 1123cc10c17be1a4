#include "transient/sliding_damper.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "linalg/canonical_basis.hpp"

namespace twindeck::transient {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double SlidingDamper::slip_rate(double force_N) const {
  const double beyond = std::abs(force_N) - friction_N;
  return beyond > 0.0 ? std::copysign(beyond / damping_N_s_m, force_N) : 0.0;
}

double equivalent_slip(const SlidingDamper& damper, const Eigen::Ref<const VectorXd>& force_N) {
  double slip = 0.0;
  for (const double force : force_N) slip += force * damper.slip_rate(force);
  const double square = force_N.squaredNorm();
  return square > 0.0 ? slip / square : 0.0;
}

LinearisedModes linearised_modes(const VectorXd& omega_rad_s, const VectorXd& damping_ratio, const MatrixXd& at_dampers,
                                 const std::vector<SlidingDamper>& dampers, const VectorXd& slip, double highest_Hz) {
  const Index r = omega_rad_s.size(), d = at_dampers.rows();
  TWINDECK_ASSERT(at_dampers.cols() == r && std::ssize(dampers) == d && slip.size() == d);
  // F = k_e u + c_e u' - k_e x, with what the slip takes off both.
  VectorXd k(d), c(d);
  for (Index j = 0; j < d; ++j) {
    const SlidingDamper& damper = dampers[static_cast<std::size_t>(j)];
    const double share = 1.0 / (1.0 + damper.mount_damping_N_s_m * slip[j]);
    k[j] = damper.stiffness_N_m * share;
    c[j] = damper.mount_damping_N_s_m * share;
  }
  // State (q, q', x).
  MatrixXd a = MatrixXd::Zero(2 * r + d, 2 * r + d);
  a.block(0, r, r, r).setIdentity();
  a.block(r, 0, r, r) = -at_dampers.transpose() * k.asDiagonal() * at_dampers;
  a.block(r, 0, r, r).diagonal() -= omega_rad_s.cwiseAbs2();
  a.block(r, r, r, r) = -at_dampers.transpose() * c.asDiagonal() * at_dampers;
  a.block(r, r, r, r).diagonal() -= 2.0 * damping_ratio.cwiseProduct(omega_rad_s);
  a.block(r, 2 * r, r, d) = at_dampers.transpose() * k.asDiagonal();
  a.block(2 * r, 0, d, r) = slip.cwiseProduct(k).asDiagonal() * at_dampers;
  a.block(2 * r, r, d, r) = slip.cwiseProduct(c).asDiagonal() * at_dampers;
  a.block(2 * r, 2 * r, d, d).diagonal() -= slip.cwiseProduct(k);
  const Eigen::EigenSolver<MatrixXd> eig(a);
  TWINDECK_ASSERT(eig.info() == Eigen::Success);

  std::vector<Index> kept;
  for (Index i = 0; i < a.rows(); ++i) {
    const std::complex<double> lambda = eig.eigenvalues()[i];
    // A damper that does not slide gives an eigenvalue that is zero but for rounding.
    if (lambda.imag() > 1e-6 * omega_rad_s.minCoeff() && std::abs(lambda) < 2.0 * std::numbers::pi * highest_Hz)
      kept.push_back(i);
  }
  std::ranges::sort(kept, [&](Index i, Index j) { return std::abs(eig.eigenvalues()[i]) < std::abs(eig.eigenvalues()[j]); });
  LinearisedModes modes;
  modes.frequency_Hz.resize(std::ssize(kept));
  modes.damping_ratio.resize(std::ssize(kept));
  modes.shapes.resize(r, std::ssize(kept));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::complex<double> lambda = eig.eigenvalues()[kept[i]];
    const auto at = static_cast<Index>(i);
    modes.frequency_Hz[at] = std::abs(lambda) / (2.0 * std::numbers::pi);
    modes.damping_ratio[at] = -lambda.real() / std::abs(lambda);
    const Eigen::VectorXcd shape = eig.eigenvectors().col(kept[i]).head(r);
    const std::complex<double> leading = shape[linalg::leading_entry(shape.cwiseAbs())];
    modes.shapes.col(at) = shape * (std::conj(leading) / std::abs(leading));
  }
  return modes;
}

}  // namespace twindeck::transient
