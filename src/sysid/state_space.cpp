#include "sysid/state_space.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::sysid {

using Eigen::Index;

Eigen::VectorXcd normalised_shape(const Eigen::VectorXcd& shape) {
  const double length = shape.norm();
  if (!(length > 0.0)) return shape;
  const std::complex<double> sum = (shape.transpose() * shape).value();
  Eigen::VectorXcd turned = shape / length * std::polar(1.0, -0.5 * std::arg(sum));
  Index largest = 0;
  turned.cwiseAbs().maxCoeff(&largest);
  if (turned[largest].real() < 0.0) turned = -turned;
  return turned;
}

namespace {

std::vector<Pole> poles_of(const Eigen::MatrixXd& a, const Eigen::Ref<const Eigen::MatrixXd>& c, int order, double rate_Hz) {
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(a);
  std::vector<Pole> poles;
  if (eigen.info() != Eigen::Success) return poles;
  for (Index i = 0; i < a.rows(); ++i) {
    const std::complex<double> mu = eigen.eigenvalues()[i];
    if (!(mu.imag() > 0.0)) continue;
    Pole pole;
    pole.order = order;
    pole.eigenvalue = std::log(mu) * rate_Hz;
    pole.frequency_Hz = std::abs(pole.eigenvalue) / (2.0 * std::numbers::pi);
    pole.damping_ratio = -pole.eigenvalue.real() / std::abs(pole.eigenvalue);
    const Eigen::VectorXcd phi = eigen.eigenvectors().col(i);
    pole.shape = normalised_shape(c * phi);
    poles.push_back(pole);
  }
  std::sort(poles.begin(), poles.end(), [](const Pole& p, const Pole& q) { return p.frequency_Hz < q.frequency_Hz; });
  return poles;
}

}  // namespace

std::vector<std::vector<Pole>> poles_of_orders(const Observability& observability, const std::vector<int>& orders, double rate_Hz) {
  const Eigen::MatrixXd& o = observability.matrix;
  const Index rows = o.rows() - observability.n_outputs;
  const Index n_max = orders.empty() ? 0 : *std::max_element(orders.begin(), orders.end());
  TWINDECK_ASSERT(n_max <= o.cols() && n_max <= rows);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(o.topLeftCorner(rows, n_max));
  const Eigen::MatrixXd rotated = (qr.householderQ().transpose() * o.bottomLeftCorner(rows, n_max)).topRows(n_max);
  std::vector<std::vector<Pole>> poles;
  for (const int order : orders) {
    const Eigen::MatrixXd a =
        qr.matrixQR().topLeftCorner(order, order).triangularView<Eigen::Upper>().solve(rotated.topLeftCorner(order, order));
    poles.push_back(poles_of(a, o.topLeftCorner(observability.n_outputs, order), order, rate_Hz));
  }
  return poles;
}

}  // namespace twindeck::sysid
