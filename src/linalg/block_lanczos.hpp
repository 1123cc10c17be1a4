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
  Eigen::MatrixXd vectors;  ///< (n × found) M-orthonormal, those of the largest eigenvalues first
  int converged = 0;
  int operations = 0;
};

/// Largest eigenvalues of an operator A^-1 M, by block Lanczos with full reorthogonalisation and thick restart.
/// A block of width w is certain to find up to w copies of a repeated eigenvalue.
/// @param start  start(0) gives the first block (n × width). start(1), start(2), … give further blocks, which are used when the
///               basis spans an invariant subspace before enough pairs are found. Linearly dependent columns are dropped.
[[nodiscard]] BlockLanczosResult block_lanczos(const SelfAdjointOperator& op,
                                               const std::function<Eigen::MatrixXd(int draw)>& start, int n_pairs);

}  // namespace twindeck::linalg
