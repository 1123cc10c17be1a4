#include "linalg/block_lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "linalg/dense.hpp"
#include "linalg/orthonormal_block.hpp"

namespace twindeck::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The Lanczos basis with its projected operator.
struct Basis {
  MatrixXd v, mass_v;  ///< (n × capacity), `size` columns in use
  MatrixXd projected;  ///< (capacity × capacity)
  Index size = 0;

  void append(const OrthonormalBlock& block) {
    v.middleCols(size, block.q.cols()) = block.q;
    mass_v.middleCols(size, block.q.cols()) = block.mass_q;
    size += block.q.cols();
  }
  /// Makes `w` orthogonal to the basis. The image of the last block has a part along the last two only, but for rounding: taken
  /// off first, it leaves a remainder of which one pass over the whole basis takes the rest.
  /// @param near  first column of the basis along which `w` has more than rounding (0: all of it)
  /// @return what was taken off, (size × columns of w)
  MatrixXd remove_from(MatrixXd& w, Index near) const {
    MatrixXd total = MatrixXd::Zero(size, w.cols());
    for (const Index first : {near, Index{0}}) {
      const MatrixXd c = product(mass_v.middleCols(first, size - first), w, true);
      subtract_product(v.middleCols(first, size - first), c, w);
      total.bottomRows(size - first) += c;
    }
    return total;
  }
};

}  // namespace

BlockLanczosResult block_lanczos(const SelfAdjointOperator& op, const std::function<MatrixXd(int)>& start,
                                 const BlockLanczosOptions& options) {
  const Index wanted = options.n_pairs;
  const MatrixXd first_block = start(0);
  const Index width = first_block.cols();
  // Room for the wanted pairs, as many again to hasten them, and the last block.
  const Index capacity = std::min(op.size, std::max<Index>(2 * wanted + 2 * width, wanted + 6 * width)) + width;
  Basis basis{MatrixXd(op.size, capacity), MatrixXd(op.size, capacity), MatrixXd::Zero(capacity, capacity), 0};

  BlockLanczosResult result;
  const MatrixXd mass_first = op.times_mass(first_block);
  OrthonormalBlock next = orthonormalise(first_block, mass_first, mass_norm(first_block, mass_first));
  int restarts = 0, draws = 0;
  Index before = 0;  // first column of the block before the last; 0 also where the last is coupled to all (a restart)
  while (next.q.cols() > 0) {
    const Index first = basis.size, columns = next.q.cols();
    basis.append(next);

    // One step: T's new columns are what the image of the last block has in common with the basis.
    MatrixXd w = op.from_mass(next.mass_q);
    result.operations += static_cast<int>(columns);
    const MatrixXd c = basis.remove_from(w, before);
    before = first;
    basis.projected.block(0, first, basis.size, columns) = c;
    basis.projected.block(first, 0, columns, first) = c.topRows(first).transpose();
    const MatrixXd mass_w = op.times_mass(w);
    // By Pythagoras: the basis is M-orthonormal.
    const double scale = std::hypot(std::sqrt(c.colwise().squaredNorm().maxCoeff()), mass_norm(w, mass_w));
    next = orthonormalise(std::move(w), mass_w, scale);

    MatrixXd coupling_r = next.r;
    bool exhausted = next.q.cols() == 0;
    if (exhausted && basis.size < std::min(op.size, wanted + width)) {
      // An invariant subspace: what lies outside it (further copies of its eigenvalues, say) needs a new start.
      MatrixXd fresh = start(++draws);
      const MatrixXd known = basis.remove_from(fresh, 0);
      const MatrixXd mass_fresh = op.times_mass(fresh);
      const double fresh_scale = std::hypot(std::sqrt(known.colwise().squaredNorm().maxCoeff()), mass_norm(fresh, mass_fresh));
      next = orthonormalise(std::move(fresh), mass_fresh, fresh_scale);
      coupling_r = MatrixXd::Zero(next.q.cols(), columns);
      exhausted = next.q.cols() == 0;
    }
    const bool full = basis.size + next.q.cols() + width > capacity;
    if (!exhausted && !full && basis.size < wanted + width) continue;

    MatrixXd t = basis.projected.topLeftCorner(basis.size, basis.size);
    t = 0.5 * (t + t.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(t);
    const VectorXd values = eig.eigenvalues().reverse();
    const MatrixXd s = eig.eigenvectors().rowwise().reverse();
    // Residuals (A^-1 M - theta) V s = Q R s(last block), Q orthonormal.
    const MatrixXd coupling = coupling_r * s.bottomRows(columns);
    const Index count = std::min(wanted, basis.size);
    Index converged = 0;
    while (converged < count && coupling.col(converged).norm() <= options.tolerance * std::abs(values[converged])) ++converged;

    const bool out_of_patience = full && restarts >= options.max_restarts;
    if (converged == wanted || exhausted || out_of_patience) {
      result.converged = static_cast<int>(exhausted ? count : converged);
      result.values = values.head(count);
      result.vectors = product(basis.v.leftCols(basis.size), s.leftCols(count));
      return result;
    }
    if (!full) continue;

    // Thick restart: the best Ritz vectors stay; the coupling to the next block comes back with its own step.
    ++restarts;
    const Index keep = std::min(basis.size - width, wanted + std::max<Index>(width, wanted / 2));
    basis.v.leftCols(keep) = product(basis.v.leftCols(basis.size), s.leftCols(keep));
    basis.mass_v.leftCols(keep) = product(basis.mass_v.leftCols(basis.size), s.leftCols(keep));
    basis.projected.setZero();
    basis.projected.diagonal().head(keep) = values.head(keep);
    basis.size = keep;
    before = 0;
  }
  return result;
}

}  // namespace twindeck::linalg
