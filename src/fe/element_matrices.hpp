#pragma once

#include <Eigen/Core>

namespace twindeck::fe {

// Matrices of elements in global axes; order x y z rx ry rz of each node (x y z for bars).
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

}  // namespace twindeck::fe
