#include "identification/state_space.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "linalg/canonical_basis.hpp"
#include "linalg/dense.hpp"

namespace twindeck::identification {

using Eigen::Index;

std::complex<double> eigenvalue_of(double frequency_Hz, double damping_ratio) {
  return 2.0 * std::numbers::pi * frequency_Hz *
         std::complex<double>(-damping_ratio, std::sqrt(1.0 - damping_ratio * damping_ratio));
}

Eigen::VectorXcd normalised_shape(const Eigen::VectorXcd& shape) {
  const double length = shape.norm();
  if (!(length > 0.0)) return shape;
  const std::complex<double> sum = (shape.transpose() * shape).value();
  Eigen::VectorXcd turned = shape / length * std::polar(1.0, -0.5 * std::arg(sum));
  if (turned[linalg::leading_entry(turned.cwiseAbs())].real() < 0.0) turned = -turned;
  return turned;
}

namespace {

Pole pole_of(std::complex<double> mu, const Eigen::VectorXcd& shape, int order, double rate_Hz) {
  Pole pole;
  pole.order = order;
  pole.eigenvalue = std::log(mu) * rate_Hz;
  pole.frequency_Hz = std::abs(pole.eigenvalue) / (2.0 * std::numbers::pi);
  pole.damping_ratio = -pole.eigenvalue.real() / std::abs(pole.eigenvalue);
  pole.shape = normalised_shape(shape);
  return pole;
}

void find_poles(OrderModel& model, double rate_Hz) {
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(model.a);
  if (eigen.info() != Eigen::Success) return;
  model.mu = eigen.eigenvalues();
  model.right = eigen.eigenvectors();
  model.left = model.right.partialPivLu().inverse();
  for (Index i = 0; i < model.mu.size(); ++i)
    if (model.mu[i].imag() > 0.0) model.kept.push_back(i);
  std::ranges::sort(model.kept,
                    [&](Index i, Index j) { return std::abs(std::log(model.mu[i])) < std::abs(std::log(model.mu[j])); });
  for (const Index i : model.kept) {
    const Eigen::VectorXcd phi = model.right.col(i);
    model.poles.push_back(pole_of(model.mu[i], model.c * phi, model.order, rate_Hz));
  }
}

Eigen::MatrixXd thin_q(const Eigen::MatrixXd& x) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(x);
  return qr.householderQ() * Eigen::MatrixXd::Identity(x.rows(), x.cols());
}

/// From an orthonormal basis w of the leading right space: A w = Q (R), R = X S Yᵀ; u = Q X, v = w Y. Two steps of subspace
/// iteration come first. They remove the error eps sigma_1²/sigma_j² of the vectors from the rounding of the squared matrix.
LeadingSvd refined(const Eigen::MatrixXd& a, Eigen::MatrixXd w) {
  for (int step = 0; step < 2; ++step) w = thin_q(linalg::product(a, thin_q(linalg::product(a, w)), true));
  const Eigen::MatrixXd image = linalg::product(a, w), q = thin_q(image);
  const linalg::ThinSvd small = linalg::thin_svd(linalg::product(q, image, true));
  return {linalg::product(q, small.u), small.values, linalg::product(w, small.vt.transpose())};
}

LeadingSvd by_squares(const Eigen::MatrixXd& a, Index n) {
  if (a.cols() <= a.rows()) return refined(a, linalg::leading_eigenpairs(linalg::product(a, a, true), n).vectors);
  const Eigen::MatrixXd at = a.transpose();
  const Eigen::MatrixXd u = linalg::leading_eigenpairs(linalg::product(at, at, true), n).vectors;
  const LeadingSvd turned = refined(at, u);
  return {turned.v, turned.values, turned.u};
}

}  // namespace

ShiftModels shift_models(const Observability& observability, const std::vector<int>& orders, double rate_Hz) {
  const Index rows = observability.left.rows() - observability.n_outputs;
  const Index n_max = orders.empty() ? 0 : *std::ranges::max_element(orders);
  TWINDECK_ASSERT(n_max <= observability.left.cols() && n_max <= rows);
  const Eigen::MatrixXd o =
      observability.left.leftCols(n_max) * observability.singular_values.head(n_max).cwiseSqrt().asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(o.topRows(rows));
  ShiftModels models;
  models.q = qr.householderQ() * Eigen::MatrixXd::Identity(rows, n_max);
  models.r = qr.matrixQR().topRows(n_max).triangularView<Eigen::Upper>();
  models.rotated = linalg::product(models.q, o.bottomRows(rows), true);
  models.cross = linalg::product(models.rotated, models.r, true);
  models.rate_Hz = rate_Hz;
  for (const int order : orders) {
    OrderModel model;
    model.order = order;
    model.a =
        models.r.topLeftCorner(order, order).triangularView<Eigen::Upper>().solve(models.rotated.topLeftCorner(order, order));
    model.c = o.topLeftCorner(observability.n_outputs, order);
    find_poles(model, rate_Hz);
    models.orders.push_back(std::move(model));
  }
  return models;
}

std::vector<std::vector<Pole>> poles_of(const ShiftModels& models) { return each_of(models.orders, &OrderModel::poles); }

std::vector<std::vector<Pole>> poles_of_orders(const Observability& observability, const std::vector<int>& orders,
                                               double rate_Hz) {
  return poles_of(shift_models(observability, orders, rate_Hz));
}

LeadingSvd leading_svd(const Eigen::MatrixXd& a, Index n) {
  const Index smaller = std::min(a.rows(), a.cols());
  TWINDECK_ASSERT(n >= 1 && n <= smaller);
  LeadingSvd result;
  if (smaller > 400 && 3 * n < 2 * smaller) {
    result = by_squares(a, n);
  } else {
    const linalg::ThinSvd svd = linalg::thin_svd(a);
    result = {svd.u.leftCols(n), svd.values.head(n), svd.vt.topRows(n).transpose()};
  }
  for (Index j = 0; j < n; ++j) {
    if (result.u(linalg::leading_entry(result.u.col(j).cwiseAbs()), j) < 0.0) {
      result.u.col(j) *= -1.0;
      result.v.col(j) *= -1.0;
    }
  }
  return result;
}

}  // namespace twindeck::identification
