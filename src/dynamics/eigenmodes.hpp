#pragma once

#include <Eigen/Core>

#include "core/error.hpp"
#include "fe/parametric_system.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::dynamics {

/// Undamped modes over the free degrees of freedom,  K phi = lambda M phi,  f = sqrt(lambda)/(2 pi).
struct EigenModes {
  Eigen::VectorXd frequency_Hz;  ///< (n_modes) ascending; 0 for rigid-body modes
  Eigen::VectorXd eigenvalue;    ///< (n_modes) [rad²/s²]
  Eigen::MatrixXd shapes;        ///< (n × n_modes) mass-normalised, entry of largest magnitude positive
  Status status;                 ///< not converged: fewer modes than asked for, or a K that is not positive definite
};

/// Modes of a parametric system at given parameter values; keeps the symbolic factorisation. The system must outlive the
/// solver. Each thread needs its own solver.
class ModalSolver {
 public:
  explicit ModalSolver(const fe::ParametricSystem& system);
  /// A structure that is free as a rigid body (K singular) is solved with a small negative shift.
  /// @param theta (n_parameters) in the parameters' units
  [[nodiscard]] EigenModes solve(const Eigen::VectorXd& theta, int n_modes);
  /// The same. If the structure has fewer modes (few degrees of freedom carry mass), returns all of them.
  [[nodiscard]] EigenModes solve_available(const Eigen::VectorXd& theta, int n_modes);
  [[nodiscard]] const fe::ParametricSystem& system() const { return system_; }
  /// Mass matrix (lower triangle) of the last `solve`.
  [[nodiscard]] const linalg::SparseMatrix& mass() const { return mass_; }

 private:
  const fe::ParametricSystem& system_;
  linalg::Cholesky factor_;
  linalg::SparseMatrix mass_;
};

/// A negative shift [rad²/s²] for a structure that is free as a rigid body. It is small compared with the eigenvalue of the
/// lowest elastic mode and large compared with rounding. It is -1e-4 times the least quotient of K and M on one dof, which is
/// far above that eigenvalue. 0 if no dof carries mass.
[[nodiscard]] double free_structure_shift(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass);

}  // namespace twindeck::dynamics
