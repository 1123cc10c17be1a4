#include "linalg/block_lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Basis : KrylovBasis {
  MatrixXd projected;  ///< T (capacity × capacity)

  Basis(Index n, Index capacity) : KrylovBasis(n, capacity), projected(MatrixXd::Zero(capacity, capacity)) {}
  /// Columns of T that belong to the last block. @param common  what `remove_from` took off its image
  void project(Index first, const MatrixXd& common) {
    projected.block(0, first, size, common.cols()) = common;
    projected.block(first, 0, common.cols(), first) = common.topRows(first).transpose();
  }
  struct Ritz {
    VectorXd values;  ///< descending
    MatrixXd s;       ///< the vectors in the basis
  };
  [[nodiscard]] Ritz ritz() const {
    MatrixXd t = projected.topLeftCorner(size, size);
    t = 0.5 * (t + t.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(t);
    return {eig.eigenvalues().reverse(), eig.eigenvectors().rowwise().reverse()};
  }
  /// Thick restart: keeps the best Ritz vectors. The next step finds their coupling to the next block.
  void restart(const Ritz& found, Index keep) {
    v.leftCols(keep) = product(v.leftCols(size), found.s.leftCols(keep));
    mass_v.leftCols(keep) = product(mass_v.leftCols(size), found.s.leftCols(keep));
    projected.setZero();
    projected.diagonal().head(keep) = found.values.head(keep);
    size = keep;
  }
};

}  // namespace

BlockLanczosResult block_lanczos(const SelfAdjointOperator& op, const std::function<MatrixXd(int)>& start, int n_pairs) {
  constexpr double tolerance = 1e-9;  // residual in the M norm, relative to the eigenvalue of the operator
  constexpr int max_restarts = 60;
  const Index wanted = n_pairs;
  const MatrixXd first_block = start(0);
  const Index n = first_block.rows(), width = first_block.cols();
  // Room for the wanted pairs, for as many further vectors, which speed up the convergence, and for the last block.
  const Index capacity = std::min(n, std::max<Index>(2 * wanted + 2 * width, wanted + 6 * width)) + width;
  Basis basis(n, capacity);
  const auto remainder = [&](MatrixXd w, const MatrixXd& removed) {
    MatrixXd mass_w = op.times_mass(w);
    return orthonormalise(std::move(w), std::move(mass_w), removed);
  };

  BlockLanczosResult result;
  OrthonormalBlock next = remainder(first_block, MatrixXd::Zero(1, width));
  int restarts = 0, draws = 0;
  Index before = 0;  // first column that the last block is coupled to; 0 after a restart
  while (next.q.cols() > 0) {
    const Index first = basis.size, columns = next.q.cols();
    basis.append(next);
    MatrixXd w = op.from_mass(next.mass_q);
    result.operations += static_cast<int>(columns);
    const MatrixXd common = basis.remove_from(w, before);
    before = first;
    basis.project(first, common);
    next = remainder(std::move(w), common);

    MatrixXd coupling_r = next.r;
    if (next.q.cols() == 0 && basis.size < std::min(n, wanted + width)) {
      // The basis spans an invariant subspace. Pairs outside it, such as further copies of an eigenvalue, need a new start
      // block.
      MatrixXd fresh = start(++draws);
      const MatrixXd known = basis.remove_from(fresh, 0);
      next = remainder(std::move(fresh), known);
      coupling_r = MatrixXd::Zero(next.q.cols(), columns);
    }
    const bool exhausted = next.q.cols() == 0, full = basis.size + next.q.cols() + width > capacity;
    if (!exhausted && !full && basis.size < wanted + width) continue;

    const Basis::Ritz ritz = basis.ritz();
    // Residuals (A^-1 M - theta) V s = Q R s(last block), Q orthonormal.
    const MatrixXd coupling = coupling_r * ritz.s.bottomRows(columns);
    const Index count = std::min(wanted, basis.size);
    Index converged = 0;
    while (converged < count && coupling.col(converged).norm() <= tolerance * std::abs(ritz.values[converged])) ++converged;
    if (converged == wanted || exhausted || (full && restarts >= max_restarts)) {
      result.converged = static_cast<int>(exhausted ? count : converged);
      result.vectors = product(basis.v.leftCols(basis.size), ritz.s.leftCols(count));
      return result;
    }
    if (!full) continue;
    ++restarts;
    basis.restart(ritz, std::min(basis.size - width, wanted + std::max<Index>(width, wanted / 2)));
    before = 0;
  }
  return result;
}

OrthonormalBlock orthonormalise(MatrixXd w, MatrixXd mass_w, const MatrixXd& removed) {
  const double norm = std::sqrt(std::max(0.0, w.cwiseProduct(mass_w).colwise().sum().maxCoeff()));
  const double before = std::hypot(std::sqrt(removed.colwise().squaredNorm().maxCoeff()), norm);  // by Pythagoras
  OrthonormalBlock out{std::move(w), std::move(mass_w), {}};
  out.r = MatrixXd::Identity(out.q.cols(), out.q.cols());
  for (int pass = 0; pass < 2 && out.q.cols() > 0; ++pass) {
    MatrixXd gram = product(out.q, out.mass_q, true);
    gram = 0.5 * (gram + gram.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(gram);
    const double floor = pass == 0 ? std::max(1e-22 * before * before, 1e-14 * eig.eigenvalues().maxCoeff()) : 0.25;
    Index keep = 0;
    while (keep < gram.cols() && eig.eigenvalues()[gram.cols() - 1 - keep] > floor) ++keep;
    const VectorXd root = eig.eigenvalues().tail(keep).cwiseSqrt();
    const MatrixXd basis = eig.eigenvectors().rightCols(keep);
    const MatrixXd turn = basis * root.cwiseInverse().asDiagonal();
    out.q = product(out.q, turn);
    out.mass_q = product(out.mass_q, turn);
    out.r = root.asDiagonal() * basis.transpose() * out.r;
  }
  return out;
}

void KrylovBasis::append(const OrthonormalBlock& block) {
  if (const Index wanted = size + block.q.cols(); wanted > v.cols()) {
    v.conservativeResize(Eigen::NoChange, std::max(wanted, 2 * v.cols()));
    mass_v.conservativeResize(Eigen::NoChange, v.cols());
  }
  v.middleCols(size, block.q.cols()) = block.q;
  mass_v.middleCols(size, block.q.cols()) = block.mass_q;
  size += block.q.cols();
}

MatrixXd KrylovBasis::remove_from(MatrixXd& w, Index near) const {
  MatrixXd total = MatrixXd::Zero(size, w.cols());
  for (const Index first : {near, Index{0}}) {
    const MatrixXd part = product(mass_v.middleCols(first, size - first), w, true);
    subtract_product(v.middleCols(first, size - first), part, w);
    total.bottomRows(size - first) += part;
  }
  return total;
}

}  // namespace twindeck::linalg
