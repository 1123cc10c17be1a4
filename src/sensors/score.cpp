#include "sensors/score.hpp"

#include <Eigen/QR>
#include <limits>

#include "core/error.hpp"

namespace twindeck::sensors {
using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd auto_mac(const Eigen::Ref<const MatrixXd>& phi) {
  const MatrixXd product = phi.transpose() * phi;
  MatrixXd mac(product.rows(), product.cols());
  for (Index i = 0; i < mac.rows(); ++i) {
    for (Index j = 0; j < mac.cols(); ++j) {
      const double norms = product(i, i) * product(j, j);
      mac(i, j) = norms > 0.0 && i != j ? product(i, j) * product(i, j) / norms : 1.0;
    }
  }
  return mac;
}

double decoupling_score(const Eigen::Ref<const MatrixXd>& phi) {
  const Index n = phi.cols();
  TWINDECK_ASSERT(n >= 2);
  return (auto_mac(phi).sum() - static_cast<double>(n)) / static_cast<double>(n * (n - 1));
}

double log_determinant(const Eigen::Ref<const MatrixXd>& phi) {
  // A pivot of R below this share of the largest is rounding: it stands at 1e-15, and shapes are known to 1e-9 at best.
  constexpr double least_pivot = 1e-12;
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  if (phi.rows() < phi.cols()) return nothing;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(phi);
  qr.setThreshold(least_pivot);
  if (qr.rank() < phi.cols()) return nothing;
  return 2.0 * qr.matrixQR().diagonal().cwiseAbs().array().log().sum();
}

}  // namespace twindeck::sensors
