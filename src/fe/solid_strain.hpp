#pragma once

#include <Eigen/Core>

/// Inside of the library: strain and elasticity of solids, in the order xx, yy, zz, xy, yz, zx with engineering shears.
namespace twindeck::fe {

/// Columns 3i, 3i+1, 3i+2 of the strain matrix (6 × 3n) from the gradient of function i.
template <typename Strain>
void set_strain(const Eigen::Vector3d& g, int i, Strain& b) {
  b.col(3 * i) << g.x(), 0.0, 0.0, g.y(), 0.0, g.z();
  b.col(3 * i + 1) << 0.0, g.y(), 0.0, g.x(), g.z(), 0.0;
  b.col(3 * i + 2) << 0.0, 0.0, g.z(), 0.0, g.y(), g.x();
}

/// Isotropic elasticity for unit E: stresses from strains.
inline Eigen::Matrix<double, 6, 6> elasticity(double nu) {
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.topLeftCorner<3, 3>().setConstant(nu);
  d.topLeftCorner<3, 3>().diagonal().setConstant(1.0 - nu);
  d.bottomRightCorner<3, 3>().diagonal().setConstant(0.5 - nu);
  return d / ((1.0 + nu) * (1.0 - 2.0 * nu));
}

/// The same scalar for each of the three displacements of a pair of nodes.
template <typename Scalar>
[[nodiscard]] auto for_three(const Scalar& scalar) {
  constexpr int n = Scalar::RowsAtCompileTime, size = n == Eigen::Dynamic ? Eigen::Dynamic : 3 * n;
  Eigen::Matrix<double, size, size> all = Eigen::Matrix<double, size, size>::Zero(3 * scalar.rows(), 3 * scalar.cols());
  for (Eigen::Index i = 0; i < scalar.rows(); ++i)
    for (Eigen::Index j = 0; j < scalar.cols(); ++j)
      all.template block<3, 3>(3 * i, 3 * j).diagonal().setConstant(scalar(i, j));
  return all;
}

/// The stresses of that order as a symmetric tensor.
inline Eigen::Matrix3d stress_tensor(const Eigen::Matrix<double, 6, 1>& s) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return tensor;
}

}  // namespace twindeck::fe
