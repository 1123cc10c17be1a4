#pragma once

#include <Eigen/Core>

namespace twindeck::linalg {

/// A block W = Q R with Q M-orthonormal; Q has fewer columns than W where W is rank-deficient.
struct OrthonormalBlock {
  Eigen::MatrixXd q, mass_q, r;
};

/// Orthonormalises `w` in the inner product of M by the eigenvectors of its Gram matrix, twice because of rounding.
/// @param mass_w  M w; receives the same combinations as w, so that one product with M is enough
/// @param scale   norm of the columns before they were made orthogonal to a basis; below 1e-11 of it only rounding is left
[[nodiscard]] OrthonormalBlock orthonormalise(Eigen::MatrixXd w, Eigen::MatrixXd mass_w, double scale);

/// Largest M-norm of the columns.
[[nodiscard]] double mass_norm(const Eigen::MatrixXd& w, const Eigen::MatrixXd& mass_w);

}  // namespace twindeck::linalg
