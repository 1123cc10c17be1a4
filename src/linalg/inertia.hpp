#pragma once

#include "linalg/types.hpp"

namespace twindeck::linalg {

/// Number of eigenvalues of K x = lambda M x below `value`: the negative pivots of K - value M = L D L' (Sylvester's law of
/// inertia). It proves that no mode was missed. It costs a factorisation; use it for checks.
/// @throws InputError  if `value` is an eigenvalue to working precision
[[nodiscard]] int count_eigenvalues_below(const SparseMatrix& stiffness, const SparseMatrix& mass, double value);

}  // namespace twindeck::linalg
