#pragma once

#include <Eigen/Core>

#include "linalg/cholesky.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::transient {

/// Ritz vectors: coordinates in which mass is the unit matrix and stiffness is diagonal. The first ones are the given modes;
/// the others hold what the static shapes add.
struct ReducedBasis {
  Eigen::VectorXd omega_rad_s;  ///< (r) ascending
  Eigen::MatrixXd vectors;      ///< (n × r) over the free degrees of freedom, V' M V = I, V' K V = diag(omega²)
};

/// Static shapes K⁻¹ P of load patterns (residual flexibility). The part in the span of the modes is removed. Of the rest, the
/// `count` shapes with the most strain energy are returned. A few coordinates then give the correct response to slow loads.
/// @param factor    of K
/// @param mass      lower triangle (n × n)  @param modes  (n × m) M-orthonormal
/// @param patterns  (n × k) loads, each scaled by its size, because their energies are compared
/// @return (n × min(count, rank)) M-orthonormal and M-orthogonal to the modes
/// Reference: Dickens, Nakagawa and Wittbrodt (1997), Computers & Structures 62, 985-998 (modal truncation augmentation).
[[nodiscard]] Eigen::MatrixXd static_corrections(const linalg::Cholesky& factor, const linalg::SparseMatrix& mass,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& modes,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& patterns, Eigen::Index count);

/// K⁻¹ P, K⁻¹ M K⁻¹ P, …: `generations` blocks, each the static response to the inertia of the block before. If the
/// patterns act at the points of interest, the first block gives the correct slow motion there under any load. Each further
/// block is correct to the next power of the frequency.
/// @return (n × generations k), columns of unit length; patterns that are zero (points held by supports) are not counted in k
/// Reference: Wilson, Yuan and Dickens (1982), Earthq. Eng. Struct. Dyn. 10, 813-821 (load-dependent Ritz vectors).
[[nodiscard]] Eigen::MatrixXd krylov_shapes(const linalg::Cholesky& factor, const linalg::SparseMatrix& mass,
                                            const Eigen::Ref<const Eigen::MatrixXd>& patterns, Eigen::Index generations);

/// Ritz vectors of the space of `modes` and `shapes`. Linearly dependent shapes are dropped.
/// @param stiffness, mass  lower triangles (n × n)  @param modes  (n × m) M-orthonormal  @param shapes  (n × k) any
/// Reference: Craig (1987), A review of time-domain and frequency-domain component mode synthesis methods, J. Modal Analysis 2.
[[nodiscard]] ReducedBasis reduced_basis(const linalg::SparseMatrix& stiffness, const linalg::SparseMatrix& mass,
                                         const Eigen::Ref<const Eigen::MatrixXd>& modes,
                                         const Eigen::Ref<const Eigen::MatrixXd>& shapes);

}  // namespace twindeck::transient
