#pragma once

#include <Eigen/SparseCholesky>
#include <stdexcept>

#include "linalg/sparse.hpp"

/// Oracle: number of eigenvalues of K x = lambda M x below `value`, the negative pivots of K - value M = L D L' (Sylvester's
/// law of inertia). It proves that no mode was missed. @param stiffness, mass  lower triangles
/// @throws std::domain_error  if `value` is an eigenvalue to working precision
[[nodiscard]] inline Eigen::Index count_eigenvalues_below(const twindeck::linalg::SparseMatrix& stiffness,
                                                          const twindeck::linalg::SparseMatrix& mass, double value) {
  const Eigen::SimplicialLDLT<twindeck::linalg::SparseMatrix, Eigen::Lower> factor(stiffness - value * mass);
  const Eigen::VectorXd pivots = factor.vectorD();
  if (factor.info() != Eigen::Success || !pivots.allFinite() || (pivots.array() == 0.0).any())
    throw std::domain_error("an eigenvalue stands at the value itself");
  return (pivots.array() < 0.0).count();
}
