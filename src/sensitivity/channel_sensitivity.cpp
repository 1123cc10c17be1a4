#include "sensitivity/channel_sensitivity.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "linalg/block_lanczos.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"

namespace twindeck::sensitivity {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using linalg::product;
using linalg::symmetric_product;

constexpr double kAdjointTolerance = 1e-7;  ///< residual of an adjoint vector, in the M norm
constexpr int kMostBlocks = 100;            ///< far above what sensors of a structure need (six to twelve)

/// Effect of a parameter on the modes: right-hand sides of Nelson's equations, and their solution in the span of the modes.
struct ModalForces {
  MatrixXd force;  ///< (n × n_modes)  -(dK - lambda_i dM) phi_i, without the term of dlambda_i, which is parallel to M phi_i
  MatrixXd along;  ///< (n_modes × n_modes) part of dphi_i along phi_j: phi_j' force_i / (lambda_j - lambda_i). For j = i and
                   ///< inside a cluster the normalisation gives -1/2 phi_j' dM phi_i
};

/// @param cluster_gap  relative difference of eigenvalues that are taken as equal
ModalForces modal_forces(const fe::ParametricSystem& system, const VectorXd& theta, const dynamics::EigenModes& modes,
                         int parameter, double cluster_gap) {
  const MatrixXd& phi = modes.shapes;
  const VectorXd& lambda = modes.eigenvalue;
  const MatrixXd d_mass_phi = system.mass_derivative_times(theta, parameter, phi);
  ModalForces out;
  out.force = -system.stiffness_derivative_times(theta, parameter, phi);
  out.force.noalias() += d_mass_phi * lambda.asDiagonal();
  const MatrixXd modal_force = product(phi, out.force, true), modal_mass = product(phi, d_mass_phi, true);
  out.along.resize(phi.cols(), phi.cols());
  for (Index i = 0; i < phi.cols(); ++i) {
    for (Index j = 0; j < phi.cols(); ++j) {
      const double gap = lambda[j] - lambda[i];
      const bool together = i == j || std::abs(gap) <= cluster_gap * std::max(std::abs(lambda[i]), std::abs(lambda[j]));
      out.along(j, i) = together ? -0.5 * modal_mass(j, i) : modal_force(j, i) / gap;
    }
  }
  return out;
}

/// Factorises K(theta) - shift M, the shift 0 or, for a structure that is free as a rigid body, a small negative number.
/// @param stiffness  in: K; out: K - shift M @return the shift [rad²/s²]
double factorize_shifted(linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass, linalg::Cholesky& factor) {
  if (factor.factorize(stiffness).converged) return 0.0;
  const double shift = dynamics::free_structure_shift(stiffness, mass);
  stiffness = stiffness - shift * mass;
  stiffness.makeCompressed();
  const Status status = factor.factorize(stiffness);
  TWINDECK_ASSERT(status.converged);  // the modes were solved for with this very matrix
  return shift;
}

/// Adjoint vectors of all modes in one basis: y_i = Y0 + V Z_i.
struct Adjoint {
  MatrixXd statics;         ///< Y0 = A⁻¹ P'C (n × n_channels); P' removes the part in the modes
  MatrixXd basis;           ///< V (n × r) M-orthonormal, M-orthogonal to the modes
  std::vector<MatrixXd> z;  ///< (n_modes) Z_i (r × n_channels)
};

/// Rows with an entry. The force of a parameter acts on its own elements only, that of a damper on two nodes.
std::vector<Index> rows_in_use(const MatrixXd& force) {
  std::vector<Index> rows;
  const VectorXd size = force.rowwise().lpNorm<Eigen::Infinity>();
  for (Index i = 0; i < size.size(); ++i) {
    if (size[i] > 0.0) rows.push_back(i);
  }
  return rows;
}

/// With T = A⁻¹ M outside the modes and s = lambda - shift, (A - s M)⁻¹ P'C = Y0 + s (1 - s T)⁻¹ T Y0. Galerkin in the block
/// Krylov space V of T from T Y0, H = V'M T V: (1 - s H) Z = s R with V R = T Y0. What is neglected is s Q S Z, with T V = V H
/// + Q S.
class AdjointSpace {
 public:
  AdjointSpace(const fe::ParametricSystem& system, const VectorXd& theta, const dynamics::EigenModes& modes)
      : AdjointSpace(system.stiffness(theta), system.mass(theta), modes) {}
  AdjointSpace(linalg::SparseMatrix stiffness, const linalg::SparseMatrix& mass, const dynamics::EigenModes& modes)
      : modes_(modes), mass_(linalg::without_zeros(mass)) {
    shift_ = factorize_shifted(stiffness, mass, factor_);
    mass_shapes_ = symmetric_product(mass_, modes.shapes);
  }

  Adjoint solve(const Eigen::Ref<const MatrixXd>& channels) {
    Adjoint out;
    MatrixXd outside = channels;
    linalg::subtract_product(mass_shapes_, product(modes_.shapes, channels, true), outside);
    out.statics = from_mass(outside);
    const MatrixXd mass_statics = symmetric_product(mass_, out.statics);
    const VectorXd size = out.statics.cwiseProduct(mass_statics).colwise().sum().cwiseAbs().cwiseSqrt();

    linalg::KrylovBasis basis(channels.rows(), 8 * channels.cols());
    MatrixXd w = from_mass(mass_statics), h(0, 0);
    linalg::OrthonormalBlock next = linalg::orthonormalise(w, symmetric_product(mass_, w), MatrixXd::Zero(1, w.cols()));
    const MatrixXd start = next.r;
    Index before = 0;  // first column of the block before the last
    for (int block = 0; block < kMostBlocks && next.q.cols() > 0; ++block) {
      const Index columns = next.q.cols(), last = basis.size;
      basis.append(next);
      w = from_mass(next.mass_q);
      const MatrixXd common = basis.remove_from(w, before);
      before = last;
      h.conservativeResize(basis.size, basis.size);
      h.rightCols(columns) = common;
      h.bottomRows(columns) = common.transpose();
      MatrixXd mass_w = symmetric_product(mass_, w);
      next = linalg::orthonormalise(std::move(w), std::move(mass_w), common);
      if (solve_small(h, start, next.r, size, out.z)) break;
    }
    out.basis = basis.v.leftCols(basis.size);
    return out;
  }

 private:
  /// A⁻¹ B without its part in the modes, which is rounding.
  MatrixXd from_mass(const MatrixXd& b) const {
    MatrixXd x = factor_.solve(b);
    linalg::subtract_product(modes_.shapes, product(mass_shapes_, x, true), x);
    return x;
  }

  /// Z of every mode. @param size  M-norms of the static parts @return whether all residuals are within the tolerance
  bool solve_small(const MatrixXd& h, const MatrixXd& start, const MatrixXd& coupling, const VectorXd& size,
                   std::vector<MatrixXd>& z) const {
    z.clear();
    bool good = true;
    for (const double lambda : modes_.eigenvalue) {
      const double s = lambda - shift_;
      const MatrixXd matrix = MatrixXd::Identity(h.rows(), h.rows()) - s * h;
      MatrixXd right = MatrixXd::Zero(h.rows(), start.cols());
      right.topRows(start.rows()) = s * start;
      z.push_back(matrix.ldlt().solve(right));
      const MatrixXd neglected = s * coupling * z.back().bottomRows(coupling.cols());
      for (Index c = 0; c < start.cols(); ++c)
        good = good && neglected.col(c).norm() <= kAdjointTolerance * (size[c] + z.back().col(c).norm());
    }
    return good;
  }

  const dynamics::EigenModes& modes_;
  linalg::SparseMatrix mass_;  // lower triangle, without stored zeros
  linalg::Cholesky factor_;
  double shift_ = 0.0;
  MatrixXd mass_shapes_;
};

}  // namespace

std::vector<MatrixXd> channel_shape_derivatives(const fe::ParametricSystem& system, const VectorXd& theta,
                                                const dynamics::EigenModes& modes, const Eigen::Ref<const MatrixXd>& channels,
                                                double cluster_gap) {
  const Adjoint adjoint = AdjointSpace(system, theta, modes).solve(channels);
  const MatrixXd measured = product(channels, modes.shapes, true);
  const auto count = static_cast<int>(system.parameters.size());
  std::vector<MatrixXd> all(static_cast<std::size_t>(count));
  parallel_for(count, [&](int p) {
    const ModalForces forces = modal_forces(system, theta, modes, p, cluster_gap);
    const std::vector<Index> rows = rows_in_use(forces.force);
    MatrixXd derivative, share;
    if (std::ssize(rows) < forces.force.rows() / 4) {
      const MatrixXd force = forces.force(rows, Eigen::all);
      derivative = product(adjoint.statics(rows, Eigen::all), force, true);
      share = product(adjoint.basis(rows, Eigen::all), force, true);
    } else {  // here the zeros cost less than taking rows out of the basis
      derivative = product(adjoint.statics, forces.force, true);
      share = product(adjoint.basis, forces.force, true);
    }
    derivative += measured * forces.along;
    for (Index i = 0; i < derivative.cols(); ++i)
      derivative.col(i) += adjoint.z[static_cast<std::size_t>(i)].transpose() * share.col(i);
    all[static_cast<std::size_t>(p)] = std::move(derivative);
  });
  return all;
}

}  // namespace twindeck::sensitivity
