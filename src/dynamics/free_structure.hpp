#pragma once

#include "linalg/cholesky.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::dynamics {

/// A negative shift [rad²/s²] for a structure that is free as a rigid body. It is small compared with the eigenvalue of the
/// lowest elastic mode and large compared with rounding. It is -1e-4 times the least quotient of K and M on one dof, which is
/// far above that eigenvalue. 0 if no dof carries mass.
[[nodiscard]] double free_structure_shift(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass);

}  // namespace twindeck::dynamics
