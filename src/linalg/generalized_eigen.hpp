#pragma once

#include <Eigen/Core>

#include "core/error.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/types.hpp"

namespace twindeck::linalg {

/// Lowest eigenpairs of K x = lambda M x.
struct EigenPairs {
  Eigen::VectorXd values;   ///< (n_pairs) ascending
  Eigen::MatrixXd vectors;  ///< (n × n_pairs) M-orthonormal, entry of largest magnitude positive
  Status status;            ///< not converged: message says how many of how many pairs
  int operations = 0;       ///< solves with the factorised matrix
};

/// Shift-invert Lanczos (Spectra SymGEigsShiftSolver's operator on CHOLMOD). M may be singular (dofs without mass).
/// @param stiffness, mass  lower triangles (n × n), same pattern or not
/// @param shift   sigma [rad²/s²]; K - sigma M must be positive definite (0, or a negative number for a free structure)
/// @param factor  keeps the symbolic factorisation between calls with one pattern
/// @param start   optional starting vectors (n × m): the modes of a neighbouring parameter set (warm start), may be empty
[[nodiscard]] EigenPairs lowest_eigenpairs(const SparseMatrix& stiffness, const SparseMatrix& mass, int n_pairs, double shift,
                                           Cholesky& factor, const Eigen::Ref<const Eigen::MatrixXd>& start);

}  // namespace twindeck::linalg
