#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fe/parametric_system.hpp"
#include "linalg/cholesky.hpp"

namespace twindeck::fe {

/// Factorises K, or refuses it as a mechanism.
///
/// A mechanism shows in one of three ways: a degree of freedom without stiffness of its own; a factorisation that breaks down;
/// or one that passes by rounding, which the Rayleigh quotient x'Kx / x'Dx (D = diagonal of K) of two inverse iterations brings
/// to light: below 1e-14 nothing but rounding resists x. The message names the node that moves most in x, and its directions.
/// @param lower    lower triangle of K (n × n)
/// @param source   model that the message names
/// @param context  ends the first sentence of the message (" without its stays"), may be empty
/// @throws InputError for a mechanism
[[nodiscard]] linalg::Cholesky factorize_or_refuse(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs,
                                                   const std::string& source, const std::string& context);

// Description of a motion of the structure for messages: the node that moves most, its coordinates and directions.

struct MotionWords {
  std::string node;        ///< "node 12"
  std::string place;       ///< " at (1, 2, 3) m", "" where coordinates are unknown
  std::string directions;  ///< "x, ry": all with at least a tenth of the largest
};

/// @param motion  (n) over the free degrees of freedom
[[nodiscard]] MotionWords words_of(const Eigen::VectorXd& motion, const std::vector<DofLabel>& dofs);

/// The motion with the least stiffness relative to `diagonal`, by inverse iteration from a fixed start.
[[nodiscard]] Eigen::VectorXd softest_motion(const linalg::Cholesky& factor, const Eigen::VectorXd& diagonal, int iterations);

}  // namespace twindeck::fe
