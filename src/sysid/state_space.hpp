#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::sysid {

/// A pole of a discrete state-space model as a vibration mode.
struct Pole {
  int order = 0;                        ///< order of the model that it comes from
  std::complex<double> eigenvalue;      ///< continuous, lambda = ln(mu) · rate [rad/s], imaginary part positive
  double frequency_Hz = 0.0;            ///< |lambda| / (2 pi), undamped
  double damping_ratio = 0.0;           ///< -Re lambda / |lambda| [-]
  Eigen::VectorXcd shape;               ///< (n_outputs) C phi, unit norm, turned so that its real part is as large as it can be
};

/// An observability matrix of the largest order wanted, whose first n columns are that of order n.
struct Observability {
  Eigen::MatrixXd matrix;            ///< (n_outputs block_rows × n_max)
  Eigen::Index n_outputs = 0;
  Eigen::VectorXd singular_values;   ///< (n_max) of the Hankel or Toeplitz matrix, descending
};

/// Poles of the models of several orders in one pass. The shift equation  O_up(:,1:n) A_n = O_down(:,1:n)  is solved for the
/// largest order by one QR decomposition O_up = Q R; A_n = R(1:n,1:n)^-1 (Q' O_down)(1:n,1:n) is then the least-squares solution
/// of every smaller order, exactly. Real and conjugate poles are left out, one of each pair is kept.
/// @param orders   ascending, each at most the number of columns of O
/// @param rate_Hz  sampling rate of the correlations or data
/// @return one list an order, ascending in frequency
/// Reference: Doehler and Mevel (2012), Mechanical Systems and Signal Processing 38(2), 346-366 (fast multi-order computation).
[[nodiscard]] std::vector<std::vector<Pole>> poles_of_orders(const Observability& observability, const std::vector<int>& orders,
                                                             double rate_Hz);

/// Unit norm, phase such that the sum of squares of the entries is real and positive; the sign makes the largest entry's real part
/// positive. Zero stays zero.
[[nodiscard]] Eigen::VectorXcd normalised_shape(const Eigen::VectorXcd& shape);

}  // namespace twindeck::sysid
