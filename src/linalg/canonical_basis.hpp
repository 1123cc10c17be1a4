#pragma once

#include <Eigen/Core>

namespace twindeck::linalg {

/// Position of the largest magnitude; of those that are alike to one part in a million the first. Rounding can make either of two
/// equal entries the larger, on another processor the other: a sign that hangs on it would turn a whole column.
/// @param magnitudes  not negative (n), n > 0
[[nodiscard]] Eigen::Index leading_entry(const Eigen::Ref<const Eigen::VectorXd>& magnitudes);

/// Chooses signs, and among modes of one eigenvalue the basis, by a rule that rounding cannot turn. Eigenvalues within 1e-8 of one
/// another count as one. In such a cluster the row of greatest norm (`leading_entry`) is the pivot of its first vector, in which the
/// others are zero; the rest goes on likewise. Each vector is positive at its pivot; a mode alone thus at its largest entry.
/// Orthogonal columns (in any inner product) stay so.
/// @param values   (m) ascending, not negative
/// @param vectors  (n × m) turned in place
void choose_basis(const Eigen::VectorXd& values, Eigen::MatrixXd& vectors);

}  // namespace twindeck::linalg
