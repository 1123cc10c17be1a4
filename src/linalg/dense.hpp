#pragma once

#include <Eigen/Core>

namespace twindeck::linalg {

/// Dense operations of the system's BLAS and LAPACK (OpenBLAS) on one thread. They are several times faster than Eigen's for
/// some hundreds of rows, because they choose the processor's instructions at run time.

/// @return a b, or aᵀ b if `transposed`
[[nodiscard]] Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                                      bool transposed = false);
/// @return a aᵀ, both triangles; half the work of the product
[[nodiscard]] Eigen::MatrixXd square(const Eigen::Ref<const Eigen::MatrixXd>& a);
/// c -= a b.
void subtract_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                      Eigen::MatrixXd& c);

/// Leading eigenpairs of a dense symmetric matrix.
struct LeadingEigenpairs {
  Eigen::VectorXd values;   ///< (n) descending
  Eigen::MatrixXd vectors;  ///< (size × n) orthonormal
};
/// @param symmetric (size × size), its lower triangle is read @param n  1 … size
/// Reference: Gu and Eisenstat (1995), SIAM J. Matrix Anal. Appl. 16, 172-191 (divide and conquer).
[[nodiscard]] LeadingEigenpairs leading_eigenpairs(Eigen::MatrixXd symmetric, Eigen::Index n);

/// The eigenpairs whose value is above `least`; there may be none. @param symmetric (size × size), its lower triangle is read
[[nodiscard]] LeadingEigenpairs eigenpairs_above(Eigen::MatrixXd symmetric, double least);

/// Thin singular value decomposition A = U S Vᵀ.
struct ThinSvd {
  Eigen::MatrixXd u;       ///< (rows × k), k the smaller dimension
  Eigen::VectorXd values;  ///< (k) descending
  Eigen::MatrixXd vt;      ///< (k × columns)
};
/// Reference: LAPACK's DGESDD (divide and conquer).
[[nodiscard]] ThinSvd thin_svd(Eigen::MatrixXd a);

/// Lower Cholesky factor L of a positive definite matrix, A = L Lᵀ; the upper triangle of the result is zero.
/// @param a  its lower triangle is read @return an empty matrix if A is not positive definite
[[nodiscard]] Eigen::MatrixXd cholesky_factor(Eigen::MatrixXd a);

/// L⁻¹ B for a lower triangular L, or L⁻ᵀ B if `transposed`.
/// @param lower (n × n), its lower triangle is read @param b (n × columns)
[[nodiscard]] Eigen::MatrixXd lower_solve(const Eigen::Ref<const Eigen::MatrixXd>& lower, Eigen::MatrixXd b,
                                          bool transposed = false);

/// A⁻¹ of a symmetric matrix A = L Lᵀ, both triangles, of its lower Cholesky factor L.
[[nodiscard]] Eigen::MatrixXd inverse_of_factored(Eigen::MatrixXd lower);

/// A⁻¹ B of complex or real matrices by Gaussian elimination with row exchanges. The result is not finite if A is exactly
/// singular.
/// @param a (n × n) @param b (n × columns)
[[nodiscard]] Eigen::MatrixXcd solve(Eigen::MatrixXcd a, Eigen::MatrixXcd b);
[[nodiscard]] Eigen::MatrixXd solve(Eigen::MatrixXd a, Eigen::MatrixXd b);

/// Eigenvalues and right eigenvectors of a real unsymmetric matrix, in no particular order; not finite if they do not converge.
struct UnsymmetricEigen {
  Eigen::VectorXcd values;   ///< (n)
  Eigen::MatrixXcd vectors;  ///< (n × n), columns of unit norm; empty where they were not asked for
};

/// Reference: LAPACK's DGEEV (multishift QR), several times as fast as Eigen's for some hundred rows.
[[nodiscard]] UnsymmetricEigen unsymmetric_eigen(Eigen::MatrixXd a, bool with_vectors = true);

}  // namespace twindeck::linalg
