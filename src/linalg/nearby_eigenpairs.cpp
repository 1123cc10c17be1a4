#include "linalg/nearby_eigenpairs.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "linalg/lane_basis.hpp"

namespace twindeck::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Share of a Ritz vector, in the norm of M, that may lie along directions without an image.
constexpr double kShare = 1e-6;
/// What counts of a share along known vectors: their images lie in the space but for about this.
constexpr double kKnownNearly = 0.01;
/// Directions of a sweep after the first, as many as there are lanes.
constexpr Index kWidth = 8;
constexpr int kMaxSweeps = 10;
/// Sweeps after the first in which the fixed vector takes part.
constexpr int kGuarded = 2;
constexpr double kRounding = 1e-16;

MatrixXd symmetric(const MatrixXd& a) { return 0.5 * (a + a.transpose()); }

/// An orthonormal basis of the columns of Y, each of which is small in a measure of its own, from their Gram matrix.
struct Independent {
  MatrixXd turn;         ///< Y turn is orthonormal
  MatrixXd coordinates;  ///< Y = (Y turn) coordinates
  double left = 1.0;     ///< least square of what is left of a column and of what it adds to the others

  /// @param whole  squares of what the columns were parts of; what is 1e-11 of them is rounding
  Independent(const MatrixXd& gram, const VectorXd& whole) {
    const VectorXd part = gram.diagonal().cwiseQuotient(whole).cwiseMax(kRounding);
    const VectorXd unit = (gram.diagonal().array() > 1e-22 * whole.array()).select(gram.diagonal().cwiseAbs().cwiseSqrt(), 0.0);
    const VectorXd scale = (unit.array() > 0.0).select(unit.cwiseInverse(), 0.0);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(symmetric(scale.asDiagonal() * gram * scale.asDiagonal()));
    const Index count = (eig.eigenvalues().array() > 1e-12).count();
    const MatrixXd axes = eig.eigenvectors().rightCols(count);
    const VectorXd lengths = eig.eigenvalues().tail(count).cwiseSqrt();
    turn = scale.asDiagonal() * axes * lengths.cwiseInverse().asDiagonal();
    coordinates = lengths.asDiagonal() * axes.transpose() * unit.asDiagonal();
    left = part.minCoeff() * std::max(eig.eigenvalues()[0], kRounding);
  }
};

/// An M-orthonormal basis with A projected onto it.
class Space {
 public:
  Space(const SparseMatrix& a, const SymmetricProduct& mass, const Eigen::Ref<const MatrixXd>& known)
      : a_(a), mass_(mass), basis_(known.rows()) {
    const LaneBasis start(known);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ritz(
        symmetric(start.transposed_times(symmetric_product(a, start))), symmetric(start.transposed_times(mass.times(start))));
    if (ritz.info() != Eigen::Success) return;
    basis_.append_product(start, ritz.eigenvectors());
    projected_ = ritz.eigenvalues().asDiagonal();
  }
  [[nodiscard]] const LaneBasis& basis() const { return basis_; }
  [[nodiscard]] const MatrixXd& projected() const { return projected_; }

  /// Appends what Y = A^-1 F has outside the space.
  /// @param f, y (n × width) @param along_f  VᵀF @param within  how many of the first columns of F are M V along_f
  /// @return what was appended of each column of Y: coordinates along the new columns
  MatrixXd append_images(const LaneBasis& f, LaneBasis y, const MatrixXd& along_f, Index within) {
    const MatrixXd own_f = within < y.size() ? y.transposed_times(f) : MatrixXd(0, 0);
    const Index size = basis_.size();
    LaneBasis mass_y = mass_.times(y);
    MatrixXd inside = basis_.transposed_times(mass_y), gram = y.transposed_times(mass_y);
    const VectorXd whole = gram.diagonal();
    y.subtract_product(basis_, inside);
    // By Pythagoras, as long as that leaves digits. What the basis lacks in orthogonality grows with each division by what is
    // left of an image; before it is felt, and where little is left, all is done a second time.
    gram -= inside.transpose() * inside;
    Independent part(gram, whole);
    loss_ = (loss_ + kRounding) / std::sqrt(std::max(part.left, kRounding));
    const bool again = part.left < 1e-11 || loss_ > 1e-6;
    if (again) {
      loss_ = kRounding;
      mass_y = mass_.times(y);
      gram = y.transposed_times(mass_y);
      const MatrixXd rest = basis_.transposed_times(mass_y);
      y.subtract_product(basis_, rest);
      inside += rest;
      part = Independent(gram, whole);
    }
    const MatrixXd& turn = part.turn;
    const Index count = turn.cols();
    // Y = V inside + Q coordinates, and F = M Z with Z = V along_f for all columns that start from the basis.
    images_.conservativeResizeLike(MatrixXd::Zero(size + count, images_.cols() + within));
    images_.rightCols(within) << inside.leftCols(within), part.coordinates.leftCols(within);
    starts_.conservativeResizeLike(MatrixXd::Zero(size + count, starts_.cols() + within));
    starts_.topRightCorner(size, within) = along_f.leftCols(within);
    if (count == 0) return part.coordinates;
    LaneBasis q(basis_.rows());
    q.append_product(y, turn);
    MatrixXd columns(size + count, count);
    if (again) {
      const LaneBasis stiff_q = symmetric_product(a_, q);
      columns << basis_.transposed_times(stiff_q), q.transposed_times(stiff_q);
    } else {
      // A (V along + Q) = F turn.
      const MatrixXd along = inside * turn;
      columns.topRows(size) = along_f * turn - projected_ * along;
      columns.bottomRows(count) = -columns.topRows(size).transpose() * along;
      if (own_f.size() > 0) columns.bottomRows(count) += turn.transpose() * (own_f - inside.transpose() * along_f) * turn;
    }
    basis_.append(std::move(q));
    projected_.conservativeResize(size + count, size + count);
    projected_.topRightCorner(size, count) = columns.topRows(size);
    projected_.bottomLeftCorner(count, size) = columns.topRows(size).transpose();
    projected_.bottomRightCorner(count, count) = symmetric(columns.bottomRows(count));
    return part.coordinates;
  }

  /// Ritz pairs among the images alone: A Y = M Z gives the projections without A, whose rounding is as large as its stiffest
  /// parts, and the images are in equilibrium where there is no mass, which the norm of M does not see.
  /// @return coordinates in the basis (size × count), orthonormal, and their values
  [[nodiscard]] std::pair<MatrixXd, VectorXd> among_images(Index count) const {
    const VectorXd scale = images_.colwise().norm().cwiseInverse();
    const MatrixXd y = images_ * scale.asDiagonal(), z = starts_ * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> gram(y.transpose() * y);
    const Index rank = (gram.eigenvalues().array() > 1e-10).count();
    const MatrixXd turn =
        gram.eigenvectors().rightCols(rank) * gram.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(symmetric(turn.transpose() * (y.transpose() * z) * turn));
    return {y * (turn * ritz.eigenvectors().leftCols(count)), ritz.eigenvalues().head(count)};
  }

 private:
  const SparseMatrix& a_;
  const SymmetricProduct& mass_;
  LaneBasis basis_;
  MatrixXd projected_;
  MatrixXd starts_, images_;  // coordinates of Z and of A^-1 M Z, by columns
  double loss_ = kRounding;   // bound of what the basis lacks in orthogonality
};

/// Directions of a space to which A^-1 M has not been applied.
class OpenDirections {
 public:
  /// The directions first … first + count - 1 of the basis join. @param weight  what a share along them counts
  void join(Index first, Index count, double weight) {
    const Index columns = frame_.cols();
    frame_.conservativeResizeLike(MatrixXd::Zero(first + count, columns + count));
    dual_.conservativeResizeLike(MatrixXd::Zero(first + count, columns + count));
    frame_.block(first, columns, count, count).diagonal().setConstant(1.0 / weight);
    dual_.block(first, columns, count, count).diagonal().setConstant(weight);
  }
  /// @param vectors  coordinates (size of the space × any number) @return what each has along the open directions
  [[nodiscard]] MatrixXd share(const Eigen::Ref<const MatrixXd>& vectors) const { return dual_.transpose() * vectors; }
  /// Takes out the directions that matter most. @return their coordinates, of length one
  MatrixXd take(const MatrixXd& share, Index count) {
    const Eigen::JacobiSVD<MatrixXd> svd(share, Eigen::ComputeFullU);
    frame_ = (frame_ * svd.matrixU()).eval();
    dual_ = (dual_ * svd.matrixU()).eval();
    const Index left = frame_.cols() - std::min(count, frame_.cols());
    const MatrixXd taken = frame_.leftCols(frame_.cols() - left).colwise().normalized();
    frame_ = frame_.rightCols(left).eval();
    dual_ = dual_.rightCols(left).eval();
    return taken;
  }

 private:
  MatrixXd frame_, dual_;  // F'D = I; coordinates in the space by columns
};

}  // namespace

NearbyEigenpairs nearby_eigenpairs(const SparseMatrix& a, const SymmetricProduct& mass, const Cholesky& factor, int n_pairs,
                                   const Eigen::Ref<const MatrixXd>& known, const VectorXd& further) {
  const Index wanted = n_pairs;
  TWINDECK_ASSERT(known.rows() == a.rows() && known.cols() >= wanted && further.size() == a.rows());
  NearbyEigenpairs out;
  Space space(a, mass, known);
  if (space.basis().size() == 0) return out;

  // The wanted pairs, and beside them what A^-1 M makes of the fixed vector.
  OpenDirections open;
  open.join(wanted, known.cols() - wanted, kKnownNearly);
  LaneBasis start(a.rows());
  start.append_product(space.basis(), MatrixXd::Identity(known.cols(), wanted));
  start.append(further);
  MatrixXd coordinates;
  double first_share = 1.0;
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    out.operations += static_cast<int>(start.size());
    const LaneBasis right = mass.times(start);
    const Index before = space.basis().size();
    if (sweep == 0) coordinates = space.basis().transposed_times(right);
    const MatrixXd outside = space.append_images(right, factor.solve(right), coordinates, sweep == 0 ? wanted : start.size());
    open.join(before, outside.rows(), 1.0);

    const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(space.projected());
    MatrixXd share = open.share(ritz.eigenvectors().leftCols(wanted));
    const double largest = share.rows() > 0 ? share.colwise().norm().maxCoeff() : 0.0;
    if ((sweep > 0 || share.rows() == 0) && largest < kShare) {
      MatrixXd lowest;
      std::tie(lowest, out.values) = space.among_images(wanted);
      coordinates = ritz.eigenvectors().leftCols(known.cols());
      coordinates.leftCols(wanted) = lowest;
      LaneBasis vectors(a.rows());
      vectors.append_product(space.basis(), coordinates);
      out.space = vectors.dense();
      out.converged = true;
      return out;
    }
    // At this pace, is there an end in time?
    if (sweep == 0) first_share = largest;
    if (sweep > 1 && largest * std::pow(largest / first_share, static_cast<double>(kMaxSweeps - sweep - 1) / sweep) > kShare)
      break;
    if (sweep < kGuarded) {
      // First of the next is what came of the fixed vector: of the last column, then of the first.
      VectorXd guard = VectorXd::Zero(space.basis().size());
      guard.tail(outside.rows()) = outside.col(sweep == 0 ? wanted : 0).normalized();
      share.conservativeResize(Eigen::NoChange, wanted + 1);
      share.col(wanted) = open.share(guard);
    }
    start = LaneBasis(a.rows());
    coordinates = open.take(share, kWidth);
    start.append_product(space.basis(), coordinates);
  }
  return out;
}

}  // namespace twindeck::linalg
