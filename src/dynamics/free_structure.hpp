#pragma once

#include "linalg/cholesky.hpp"
#include "linalg/types.hpp"

namespace twindeck::dynamics {

/// A shift below zero [rad²/s²] for a structure that is free as a rigid body: small against the lowest elastic mode, which is
/// far below the least quotient of K and M on one dof, and large against rounding. 0 where no dof carries mass.
[[nodiscard]] double free_structure_shift(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass);

}  // namespace twindeck::dynamics
