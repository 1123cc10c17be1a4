#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace twindeck::identification {

/// A pole of a discrete state-space model as a vibration mode.
struct Pole {
  int order = 0;                    ///< order of the model that it comes from
  std::complex<double> eigenvalue;  ///< continuous, lambda = ln(mu) · rate [rad/s], imaginary part positive
  double frequency_Hz = 0.0;        ///< |lambda| / (2 pi), undamped
  double damping_ratio = 0.0;       ///< -Re lambda / |lambda| [-]
  Eigen::VectorXcd shape;           ///< (n_outputs) C phi, unit norm, phase with the largest real part
};

/// An observability matrix of the largest order wanted, whose first n columns are that of order n: O = U S^(1/2) of the leading
/// singular triplets of a Hankel or Toeplitz matrix H.
struct Observability {
  Eigen::MatrixXd left;             ///< U (n_outputs block_rows × n_max)
  Eigen::VectorXd singular_values;  ///< S (n_max) descending
  Eigen::MatrixXd right;            ///< V (columns of H × n_max)
  Eigen::Index n_outputs = 0;

  [[nodiscard]] Eigen::MatrixXd matrix() const { return left * singular_values.cwiseSqrt().asDiagonal(); }
};

/// The model of one order, by its eigenvalues: A = right · diag(mu) · left.
struct OrderModel {
  int order = 0;
  Eigen::VectorXcd mu;             ///< (n) discrete eigenvalues
  Eigen::MatrixXcd right, left;    ///< (n × n) eigenvectors phi (columns) and their inverse
  Eigen::MatrixXd a, c;            ///< (n × n), (n_outputs × n)
  std::vector<Eigen::Index> kept;  ///< position in mu of each of the poles
  std::vector<Pole> poles;         ///< one of each conjugate pair, ascending in frequency
};

/// Models of several orders in one pass. The shift equation  O_up(:,1:n) A_n = O_down(:,1:n)  is solved for the largest order
/// by one QR decomposition O_up = Q R; A_n = R(1:n,1:n)^-1 (Q' O_down)(1:n,1:n) is then the least-squares solution of every
/// smaller order, exactly. Reference: Doehler and Mevel (2012), Mechanical Systems and Signal Processing 38(2), 346-366 (fast
/// multi-order computation).
struct ShiftModels {
  Eigen::MatrixXd q, r;     ///< Q (rows of O_up × n_max), R (n_max × n_max)
  Eigen::MatrixXd rotated;  ///< Q' O_down (n_max × n_max)
  Eigen::MatrixXd cross;    ///< O_down' O_up (n_max × n_max)
  double rate_Hz = 0.0;
  std::vector<OrderModel> orders;
};

/// @param orders   ascending, each at most the number of columns of O
/// @param rate_Hz  sampling rate of the correlations or data
[[nodiscard]] ShiftModels shift_models(const Observability& observability, const std::vector<int>& orders, double rate_Hz);

/// The poles of shift_models alone. @return one list an order, ascending in frequency; real poles are left out
[[nodiscard]] std::vector<std::vector<Pole>> poles_of(const ShiftModels& models);
[[nodiscard]] std::vector<std::vector<Pole>> poles_of_orders(const Observability& observability, const std::vector<int>& orders,
                                                             double rate_Hz);

/// The pole of a mode: lambda = omega (-zeta + i sqrt(1 - zeta²)) [rad/s].
[[nodiscard]] std::complex<double> eigenvalue_of(double frequency_Hz, double damping_ratio);

/// Unit norm, phase such that the sum of squares of the entries is real and positive; the sign makes the largest entry's real
/// part positive. Zero stays zero.
[[nodiscard]] Eigen::VectorXcd normalised_shape(const Eigen::VectorXcd& shape);

/// Leading singular triplets of a dense matrix.
struct LeadingSvd {
  Eigen::MatrixXd u;       ///< (rows × n) orthonormal, entry of largest magnitude positive
  Eigen::VectorXd values;  ///< (n) descending
  Eigen::MatrixXd v;       ///< (columns × n) orthonormal
};

/// Leading n singular triplets of a dense matrix. Small ones by divide and conquer; large ones from the leading eigenvectors of
/// A Aᵀ (or AᵀA, whichever is smaller) and steps of subspace iteration with A itself, which restore the accuracy that the
/// square lost: triplets with sigma_n > 1e-7 sigma_1 have full accuracy.
[[nodiscard]] LeadingSvd leading_svd(const Eigen::MatrixXd& a, Eigen::Index n);

}  // namespace twindeck::identification
