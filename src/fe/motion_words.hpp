#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fe/parametric_system.hpp"
#include "linalg/cholesky.hpp"

/// Description of a motion of the structure for messages: the node that moves most, its coordinates and directions.
namespace twindeck::fe {

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
