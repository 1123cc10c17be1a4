#pragma once

#include <Eigen/Core>
#include <functional>

namespace twindeck::linalg {

/// An operator A^-1 M that is self-adjoint in the (semi-)inner product of M, given by its products with blocks of vectors.
struct SelfAdjointOperator {
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> times_mass;  ///< M X
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> from_mass;   ///< A^-1 Y: the operator is from_mass(times_mass(X))
};

struct BlockLanczosResult {
  Eigen::MatrixXd vectors;  ///< (n × found) M-orthonormal, largest eigenvalue first
  int converged = 0;
  int operations = 0;
};

/// Largest eigenvalues of an operator A^-1 M, by block Lanczos with full reorthogonalisation and thick restart.
/// A block of width w is certain to find up to w copies of a repeated eigenvalue.
/// @param start  start(0) gives the first block (n × width). start(1), start(2), … give further blocks, which are used when the
///               basis spans an invariant subspace before enough pairs are found. Linearly dependent columns are dropped.
[[nodiscard]] BlockLanczosResult block_lanczos(const SelfAdjointOperator& op,
                                               const std::function<Eigen::MatrixXd(int draw)>& start, int n_pairs);

/// A block W = Q R with Q M-orthonormal; Q has fewer columns than W where W is rank-deficient.
struct OrthonormalBlock {
  Eigen::MatrixXd q, mass_q, r;
};

/// Orthonormalises `w` in the inner product of M by the eigenvectors of its Gram matrix, twice because of rounding.
/// @param mass_w   M w; receives the same combinations as w, so that one product with M is enough
/// @param removed  what an M-orthonormal basis has already taken off w (one row of zeros: nothing). A column that has become
///         shorter than 1e-11 of its earlier norm is rounding and is dropped
[[nodiscard]] OrthonormalBlock orthonormalise(Eigen::MatrixXd w, Eigen::MatrixXd mass_w, const Eigen::MatrixXd& removed);

/// The M-orthonormal basis of a block Krylov method, with its products by M.
struct KrylovBasis {
  Eigen::MatrixXd v, mass_v;  ///< (n × capacity), `size` columns in use
  Eigen::Index size = 0;

  KrylovBasis(Eigen::Index n, Eigen::Index capacity) : v(n, capacity), mass_v(n, capacity) {}
  void append(const OrthonormalBlock& block);
  /// Makes `w` orthogonal to the basis. In exact arithmetic the image of a block has components in the last two blocks only.
  /// These are taken off first. One pass over the whole basis then removes the rounding.
  /// @param near  first column of the basis along which `w` has more than rounding (0: all of it)
  /// @return what was taken off, (size × columns of w)
  [[nodiscard]] Eigen::MatrixXd remove_from(Eigen::MatrixXd& w, Eigen::Index near) const;
};

}  // namespace twindeck::linalg
