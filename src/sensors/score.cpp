#include "sensors/score.hpp"

#include <Eigen/Cholesky>
#include <cmath>
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
  const Eigen::LLT<MatrixXd> factor(phi.transpose() * phi);
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  return 2.0 * MatrixXd(factor.matrixL()).diagonal().array().log().sum();
}

}  // namespace twindeck::sensors
