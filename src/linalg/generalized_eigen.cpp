#include "linalg/generalized_eigen.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "linalg/block_lanczos.hpp"
#include "linalg/canonical_basis.hpp"
#include "linalg/dense.hpp"

namespace twindeck::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Vectors of a block. With 8, the factor is read less often, but more solves are needed: 127 instead of 91 at 29,000 degrees
/// of freedom.
constexpr int kBlock = 4;

/// Numbers in [-1, 1[ from a fixed sequence, the same on every machine; another sequence for each `draw`.
MatrixXd fixed_block(Index rows, Index columns, int draw) {
  constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;  // of SplitMix64
  const std::uint64_t state = 20130917 + static_cast<std::uint64_t>(draw) * 0x632be59bd9b4e019ULL;
  MatrixXd block(rows, columns);
  for (Index k = 0; k < block.size(); ++k)
    block.data()[k] = static_cast<double>(mixed(state + static_cast<std::uint64_t>(k) * kStep) >> 11) * 0x1.0p-52 - 1.0;
  return block;
}

/// Pairs of the operator, not yet purified, by exact condensation to the few dofs with mass: G = E' A^-1 E = C C', then C' M C
/// z = mu z, x = E C z.
BlockLanczosResult condensed(const SparseMatrix& mass, const std::vector<Index>& dofs, int n_pairs, const Cholesky& factor) {
  const auto m = static_cast<Index>(dofs.size());
  MatrixXd unit = MatrixXd::Zero(mass.rows(), m);
  for (Index j = 0; j < m; ++j) unit(dofs[static_cast<std::size_t>(j)], j) = 1.0;
  const MatrixXd flexibility = factor.solve(unit), small_mass = symmetric_product(mass, unit)(dofs, Eigen::all);
  MatrixXd small_flexibility = flexibility(dofs, Eigen::all);
  small_flexibility = 0.5 * (small_flexibility + small_flexibility.transpose()).eval();
  const MatrixXd c = small_flexibility.llt().matrixL();
  const MatrixXd projected = c.transpose() * small_mass * c;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(0.5 * (projected + projected.transpose()));
  BlockLanczosResult out;
  const double floor = 1e-13 * eig.eigenvalues().maxCoeff();
  while (out.converged < std::min<Index>(n_pairs, m) && eig.eigenvalues()[m - 1 - out.converged] > floor) ++out.converged;
  out.vectors = unit * (c * eig.eigenvectors().rightCols(out.converged).rowwise().reverse());
  out.operations = static_cast<int>(m);
  return out;
}

BlockLanczosResult by_lanczos(const SparseMatrix& mass, int n_pairs, const Cholesky& factor) {
  const SelfAdjointOperator op{[&](const MatrixXd& x) { return symmetric_product(mass, x); },
                               [&](const MatrixXd& y) { return factor.solve(y); }};
  // One application puts the block into the range of the operator, away from the null space of M.
  const auto start_block = [&](int draw) {
    return op.from_mass(symmetric_product(mass, fixed_block(mass.rows(), kBlock, draw)));
  };
  BlockLanczosResult found = block_lanczos(op, start_block, n_pairs);
  found.operations += kBlock;
  return found;
}

/// Scales each y = A^-1 M x to y'My = 1, and M x alike. In a model with nearly massless members lambda spans ten decades.
/// Without the scaling, y'My of the highest modes would be smaller than the rounding of the lowest.
void scale_to_unit_mass(MatrixXd& mass_x, MatrixXd& y, MatrixXd& mass_y) {
  for (Index j = 0; j < y.cols(); ++j) {
    const double scale = 1.0 / std::sqrt(y.col(j).dot(mass_y.col(j)));
    for (MatrixXd* block : {&mass_x, &y, &mass_y}) block->col(j) *= scale;
  }
}

}  // namespace

EigenPairs lowest_eigenpairs(const SparseMatrix& stiffness, const SparseMatrix& mass, int n_pairs, double shift,
                             Cholesky& factor) {
  TWINDECK_ASSERT(n_pairs > 0 && stiffness.rows() == mass.rows());
  EigenPairs out;
  out.vectors.resize(stiffness.rows(), 0);
  SparseMatrix shifted;
  if (shift != 0.0) {
    shifted = stiffness - shift * mass;
    shifted.makeCompressed();
  }
  const SparseMatrix& a_lower = shift != 0.0 ? shifted : stiffness;
  out.status = factor.factorize(a_lower);
  if (!out.status.converged) return out;

  const SparseMatrix mass_matrix = without_zeros(mass);
  const VectorXd own_mass = mass.diagonal();
  std::vector<Index> massive;
  for (Index i = 0; i < own_mass.rows(); ++i)
    if (own_mass[i] != 0.0) massive.push_back(i);
  if (massive.empty()) {
    out.status = {false, "no degree of freedom carries mass, so that there are no modes"};
    return out;
  }
  const bool few = static_cast<Index>(massive.size()) <= std::max<Index>(60, 3 * n_pairs);
  const BlockLanczosResult found =
      few ? condensed(mass_matrix, massive, n_pairs, factor) : by_lanczos(mass_matrix, n_pairs, factor);

  // Purification, then Rayleigh and Ritz on the purified block y = A^-1 M x: y'Ay = y'Mx and y'My give lambda - sigma.
  MatrixXd mass_x = symmetric_product(mass_matrix, found.vectors);
  MatrixXd y = factor.solve(mass_x);
  MatrixXd mass_y = symmetric_product(mass_matrix, y);
  scale_to_unit_mass(mass_x, y, mass_y);
  const MatrixXd a = product(y, mass_x, true), b = product(y, mass_y, true);
  out.operations = found.operations + static_cast<int>(found.vectors.cols());
  if (found.vectors.cols() > 0) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ritz(0.5 * (a + a.transpose()), 0.5 * (b + b.transpose()));
    out.values = ritz.eigenvalues().array() + shift;
    out.vectors = y * ritz.eigenvectors();
    choose_basis(out.values, out.vectors);
  }
  if (found.converged < n_pairs) {
    out.status = {false, fmt::format("{} of {} modes converged{}", found.converged, n_pairs,
                                     few ? ": the structure has no more (degrees of freedom with mass)" : "")};
  }
  return out;
}

}  // namespace twindeck::linalg
