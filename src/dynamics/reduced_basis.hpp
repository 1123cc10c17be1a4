#pragma once

#include <Eigen/Core>

#include "linalg/cholesky.hpp"
#include "linalg/types.hpp"

namespace twindeck::dynamics {

/// Ritz vectors: coordinates in which mass is the unit matrix and stiffness diagonal. The first ones are the modes they were
/// made from; the rest carries what static shapes add to them.
struct ReducedBasis {
  Eigen::VectorXd omega_rad_s;  ///< (r) ascending
  Eigen::MatrixXd vectors;      ///< (n × r) over the free degrees of freedom, V' M V = I, V' K V = diag(omega²)
};

/// Static shapes K⁻¹ P of load patterns, what the modes hold of them taken out, and of the rest the `count` shapes that hold
/// most of its strain energy. A structure's answer to slow loads is then right in a handful of coordinates (residual
/// flexibility).
/// @param factor    of K
/// @param mass      lower triangle (n × n)  @param modes  (n × m) M-orthonormal
/// @param patterns  (n × k) loads, each scaled by its size, for the energies are compared
/// @return (n × min(count, rank)) M-orthonormal and M-orthogonal to the modes
/// Reference: Dickens, Nakagawa and Wittbrodt (1997), Computers & Structures 62, 985-998 (modal truncation augmentation).
[[nodiscard]] Eigen::MatrixXd static_corrections(const linalg::Cholesky& factor, const linalg::SparseMatrix& mass,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& modes,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& patterns, Eigen::Index count);

/// K⁻¹ P, K⁻¹ M K⁻¹ P, …: `generations` blocks, each the static answer to the inertia of the one before. With patterns at the
/// points that are asked for, the first makes their slow motion right under any load, each further one the next power of the
/// frequency.
/// @return (n × generations k), columns of unit length; k without patterns that are zero (points held by supports)
/// Reference: Wilson, Yuan and Dickens (1982), Earthq. Eng. Struct. Dyn. 10, 813-821 (load-dependent Ritz vectors).
[[nodiscard]] Eigen::MatrixXd krylov_shapes(const linalg::Cholesky& factor, const linalg::SparseMatrix& mass,
                                            const Eigen::Ref<const Eigen::MatrixXd>& patterns, Eigen::Index generations);

/// Ritz vectors of the space of `modes` and `shapes`. Shapes that the others span already are dropped.
/// @param stiffness, mass  lower triangles (n × n)  @param modes  (n × m) M-orthonormal  @param shapes  (n × k) any
/// Reference: Craig (1987), A review of time-domain and frequency-domain component mode synthesis methods, J. Modal Analysis 2.
[[nodiscard]] ReducedBasis reduced_basis(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass,
                                         const Eigen::Ref<const Eigen::MatrixXd>& modes,
                                         const Eigen::Ref<const Eigen::MatrixXd>& shapes);

}  // namespace twindeck::dynamics
