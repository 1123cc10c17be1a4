#pragma once

#include <Eigen/Core>

namespace twindeck::linalg {

/// Position of the largest magnitude. Among magnitudes that agree to one part in a million it is the first: rounding may make
/// either of two equal entries the larger, and this may differ between processors and change the sign of a whole column.
/// @param magnitudes  >= 0 (n), n > 0
[[nodiscard]] Eigen::Index leading_entry(const Eigen::Ref<const Eigen::VectorXd>& magnitudes);

/// Chooses the signs of vectors, and the basis of a repeated eigenvalue, by a rule that does not depend on rounding.
/// Eigenvalues with a relative difference below 1e-8 form a cluster. In a cluster the row of greatest norm (`leading_entry`) is
/// the pivot of the first vector; all other vectors are zero there. The remaining vectors follow by the same rule. Each vector
/// is positive at its pivot; the pivot of a single mode is its largest entry.
/// Columns that are orthogonal in some inner product stay orthogonal.
/// @param values   (m) ascending, >= 0
/// @param vectors  (n × m) changed in place
void choose_basis(const Eigen::VectorXd& values, Eigen::MatrixXd& vectors);

}  // namespace twindeck::linalg
