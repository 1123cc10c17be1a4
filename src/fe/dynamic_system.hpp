#pragma once

#include "fe/assembly.hpp"

namespace twindeck::fe {

/// M a + C v + K u = f with everything that dissipates or is unsymmetric, over the free degrees of freedom of a
/// ParametricSystem followed by unknowns that elements have of their own. Full matrices (both triangles); M may be singular.
///
///  - Kelvin spring-dashpot (parallel): k and c between its ends, the same as two elements.
///  - Maxwell spring-dashpot (series): one unknown z, the displacement of the point between spring and dashpot,
///      force = k (e - z) = c dz/dt,   e = d·(u₁ - u₂):   K = k [[1, -1], [-1, 1]], C = diag(0, c) on (e, z),
///    so that in harmonic motion the force is i ω c k / (k + i ω c) e: a dashpot when slow, a spring when fast. It gives way to
///    a steady force, so it is no part of the ParametricSystem.
///  - Elements given by matrices: their K, C, M as they stand, own unknowns kept, in place of their conservative part.
/// Friction forces are not linear and are left to the time integration; inactive elements are left out.
/// References: Flügge (1975), Viscoelasticity, chapter 1; Warburton and Soni (1977) for non-proportional damping.
struct DynamicSystem {
  linalg::SparseMatrix mass, damping, stiffness;  ///< (n × n)
  std::vector<DofLabel> dofs;                     ///< (n_structure), those of the ParametricSystem
  std::vector<std::string> own;                   ///< names of the elements that the unknowns after them belong to
  [[nodiscard]] Eigen::Index size() const { return stiffness.rows(); }
};

/// @param system  what `assemble` returned for this model
/// @param theta   parameter values
[[nodiscard]] DynamicSystem assemble_dynamic(const Model& model, const ParametricSystem& system, const Eigen::VectorXd& theta);

}  // namespace twindeck::fe
