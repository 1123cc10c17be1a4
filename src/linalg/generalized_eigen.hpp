#pragma once

#include <Eigen/Core>

#include "core/error.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::linalg {

/// Lowest eigenpairs of K x = lambda M x.
struct EigenPairs {
  Eigen::VectorXd values;   ///< (n_pairs) ascending
  Eigen::MatrixXd vectors;  ///< (n × n_pairs) M-orthonormal, signs and bases of equal values by `choose_basis`
  Status status;            ///< not converged: message says how many of how many pairs
  int operations = 0;       ///< solves with the factorised matrix
};

/// Shift-invert block Lanczos with thick restart on the operator (K - sigma M)^-1 M in the inner product of M. A block finds
/// the copies of a repeated eigenvalue. Lanczos with a single vector (Spectra) finds them only through rounding; tests compare
/// the two. M may be singular (dofs without mass): the basis stays in the range of the operator, and one further application of
/// the operator purifies the vectors. If few dofs carry mass, the problem is condensed to them exactly and solved densely.
/// The start block is fixed, so that the same matrices give the same bytes.
/// @param stiffness, mass  lower triangles (n × n), same pattern or not
/// @param shift   sigma [rad²/s²]; K - sigma M must be positive definite (0, or a negative number for a free structure)
/// @param factor  keeps the symbolic factorisation between calls with one pattern; on return it holds that of K - sigma M
///
/// References: Grimes, Lewis and Simon (1994), SIAM J. Matrix Anal. Appl. 15, 228-272; Nour-Omid, Parlett, Ericsson and Jensen
/// (1987), Math. Comp. 48, 663-673 (purification); Wu and Simon (2000), SIAM J. Matrix Anal. Appl. 22, 602-616 (thick restart).
[[nodiscard]] EigenPairs lowest_eigenpairs(const SparseMatrix& stiffness, const SparseMatrix& mass, int n_pairs, double shift,
                                           Cholesky& factor);

}  // namespace twindeck::linalg
