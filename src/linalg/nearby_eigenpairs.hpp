#pragma once

#include <Eigen/Core>

#include "linalg/cholesky.hpp"
#include "linalg/symmetric_product.hpp"
#include "linalg/types.hpp"

namespace twindeck::linalg {

/// Lowest eigenpairs of A x = theta M x, found from those of a neighbouring pair of matrices.
struct NearbyEigenpairs {
  Eigen::VectorXd values;  ///< (n_pairs) ascending
  Eigen::MatrixXd space;   ///< (n × columns of the known) M-orthonormal Ritz vectors, those of `values` first
  bool converged = false;
  int operations = 0;  ///< solves with the factor
};

/// Rayleigh's and Ritz's method in a space that starts from the known vectors and grows by what A^-1 M makes of them: of the
/// wanted ones first, then, eight at a time, of those directions along which the Ritz vectors lie and to which A^-1 M has not
/// been applied. Along such directions a Ritz vector has what the last step corrected, so it is converged when that is little;
/// its residual is a tenth of it or less. Projections onto A follow from A (A^-1 M Z) = M Z by small matrices alone, and the
/// pairs come out of these images.
///
/// A fixed vector runs beside the known ones for some steps, so that a mode that was not among them is found.
/// @param a       lower triangle (n × n), positive definite @param factor  its factorisation
/// @param known   (n × m), m >= n_pairs: the modes of the neighbour, lowest first, and approximations of some more
/// @param further (n) the fixed vector, of any contents
/// @return not converged where the neighbour is too far away for this to be quicker than to start afresh
/// References: Bathe and Wilson (1973), Int. J. Numer. Methods Eng. 6, 213-226 (subspaces from one solve to the next); Knyazev
/// (2001), SIAM J. Sci. Comput. 23, 517-541 (a space that keeps what it had).
[[nodiscard]] NearbyEigenpairs nearby_eigenpairs(const SparseMatrix& a, const SymmetricProduct& mass, const Cholesky& factor,
                                                 int n_pairs, const Eigen::Ref<const Eigen::MatrixXd>& known,
                                                 const Eigen::VectorXd& further);

}  // namespace twindeck::linalg
