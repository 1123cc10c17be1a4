#include "transient/reduced_basis.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "linalg/canonical_basis.hpp"

namespace twindeck::transient {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

MatrixXd times(const linalg::SparseMatrix& lower, const MatrixXd& x) { return lower.selfadjointView<Eigen::Lower>() * x; }

/// Removes the part in the span of the modes, in the inner product of M. The second pass removes the rounding of the first.
MatrixXd without_modes(const linalg::SparseMatrix& mass, const MatrixXd& modes, MatrixXd x) {
  const MatrixXd weighted = times(mass, modes);
  for (int pass = 0; pass < 2; ++pass) x -= modes * (weighted.transpose() * x);
  return x;
}

/// M-orthonormal basis of the columns' space; directions below 1e-9 of the largest are rounding.
MatrixXd orthonormal(const linalg::SparseMatrix& mass, const MatrixXd& x) {
  if (x.cols() == 0) return x;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(x.transpose() * times(mass, x)));
  const Eigen::VectorXd& size = eigen.eigenvalues();
  Index dropped = 0;
  while (dropped < size.size() && !(size[dropped] > 1e-18 * size[size.size() - 1])) ++dropped;
  const Index kept = size.size() - dropped;
  return x * eigen.eigenvectors().rightCols(kept) * size.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace

MatrixXd static_corrections(const linalg::Cholesky& factor, const linalg::SparseMatrix& mass,
                            const Eigen::Ref<const MatrixXd>& modes, const Eigen::Ref<const MatrixXd>& patterns, Index count) {
  if (patterns.cols() == 0 || count == 0) return MatrixXd(modes.rows(), 0);
  const MatrixXd rest = without_modes(mass, modes, factor.solve(patterns));
  // Modes are K-orthogonal to the rest as well, so that P' rest is the rest's energy: X' K X.
  MatrixXd energy = patterns.transpose() * rest;
  energy = 0.5 * (energy + energy.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(energy);
  const Index kept = std::min(count, patterns.cols());
  return orthonormal(mass, rest * eigen.eigenvectors().rightCols(kept));
}

MatrixXd krylov_shapes(const linalg::Cholesky& factor, const linalg::SparseMatrix& mass,
                       const Eigen::Ref<const MatrixXd>& patterns, Index generations) {
  std::vector<Index> acting;  // a force on a support moves nothing
  for (Index j = 0; j < patterns.cols(); ++j) {
    if (patterns.col(j).squaredNorm() > 0.0) acting.push_back(j);
  }
  if (acting.empty() || generations == 0) return MatrixXd(mass.rows(), 0);
  MatrixXd load = patterns(Eigen::all, acting);
  MatrixXd out(mass.rows(), generations * load.cols());
  for (Index g = 0; g < generations; ++g) {
    const MatrixXd shape = factor.solve(load).colwise().normalized();
    out.middleCols(g * load.cols(), load.cols()) = shape;
    load = times(mass, shape);
  }
  return out;
}

ReducedBasis reduced_basis(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass,
                           const Eigen::Ref<const MatrixXd>& modes, const Eigen::Ref<const MatrixXd>& shapes) {
  MatrixXd scaled = shapes;
  for (Index j = 0; j < scaled.cols(); ++j) {
    const double energy = scaled.col(j).dot(times(stiffness, scaled.col(j)).col(0));
    TWINDECK_ASSERT(energy > 0.0);
    scaled.col(j) /= std::sqrt(energy);
  }
  const MatrixXd rest = orthonormal(mass, without_modes(mass, modes, scaled));
  MatrixXd all(modes.rows(), modes.cols() + rest.cols());
  all << modes, rest;
  MatrixXd k = all.transpose() * times(stiffness, all), m = all.transpose() * times(mass, all);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ritz(0.5 * (k + k.transpose()), 0.5 * (m + m.transpose()));
  TWINDECK_ASSERT(ritz.info() == Eigen::Success);
  MatrixXd vectors = all * ritz.eigenvectors();
  linalg::choose_basis(ritz.eigenvalues(), vectors);
  return {ritz.eigenvalues().cwiseMax(0.0).cwiseSqrt(), std::move(vectors)};
}

}  // namespace twindeck::transient
