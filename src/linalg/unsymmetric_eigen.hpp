#pragma once

#include <Eigen/Core>

namespace twindeck::linalg {

/// Eigenvalues and right eigenvectors of a real unsymmetric matrix, in no particular order; not finite if they do not converge.
struct UnsymmetricEigen {
  Eigen::VectorXcd values;   ///< (n)
  Eigen::MatrixXcd vectors;  ///< (n × n), columns of unit norm
};

/// Reference: LAPACK's DGEEV (multishift QR), several times as fast as Eigen's for some hundred rows.
[[nodiscard]] UnsymmetricEigen unsymmetric_eigen(Eigen::MatrixXd a);

}  // namespace twindeck::linalg
