#include "identification/perturbation.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "linalg/dense.hpp"

namespace twindeck::identification {

using Eigen::Index;

SubspaceChange subspace_change(const Observability& observability, const ShiftModels& models, const Eigen::MatrixXd& w) {
  const Index rows = models.q.rows(), l = observability.n_outputs;
  SubspaceChange change;
  change.inner = linalg::product(observability.left, w, true);
  const Eigen::MatrixXd outer = w - linalg::product(observability.left, change.inner);
  const Eigen::MatrixXd up = outer.topRows(rows);
  change.up = linalg::product(models.q, up, true);
  change.down = linalg::product(models.q, outer.bottomRows(rows), true);
  change.cross =
      observability.singular_values.cwiseSqrt().asDiagonal() * linalg::product(observability.left.bottomRows(rows), up, true);
  change.top = outer.topRows(l);
  return change;
}

namespace {

/// dO in coordinates of the columns of O beyond n (divided by their scale), and of W_perp.
struct ObservabilityChange {
  Eigen::MatrixXd beyond;       ///< (n_max - n × n)
  Eigen::VectorXd outer_scale;  ///< (n) factor of each column of W_perp
};

ObservabilityChange observability_change(const Eigen::VectorXd& sigma, const Eigen::MatrixXd& m, Index n) {
  const Index rest = sigma.size() - n;
  ObservabilityChange change{Eigen::MatrixXd::Zero(rest, n), sigma.head(n).cwiseSqrt().cwiseInverse()};
  for (Index j = 0; j < n; ++j) {
    for (Index k = 0; k < rest; ++k) {
      const double sj = sigma[j], sk = sigma[n + k];
      // Equal singular values: their vectors are not unique, but no pole depends on the choice.
      if (sj - sk <= 1e-12 * sigma[0]) continue;
      change.beyond(k, j) = (sj * m(n + k, j) + sk * m(j, n + k)) / (sj * sj - sk * sk) * std::sqrt(sj / sk);
    }
  }
  return change;
}

PoleChange changed_pole(std::complex<double> mu, std::complex<double> d_mu, double rate_Hz, const Eigen::VectorXcd& psi,
                        const Eigen::VectorXcd& d_psi, const Eigen::VectorXcd& shape) {
  PoleChange result;
  const std::complex<double> lambda = std::log(mu) * rate_Hz, d_lambda = d_mu / mu * rate_Hz;
  const double size = std::abs(lambda), d_size = (std::conj(lambda) * d_lambda).real() / size;
  result.frequency_Hz = d_size / (2.0 * std::numbers::pi);
  result.damping_ratio = -d_lambda.real() / size + lambda.real() * d_size / (size * size);
  // Scaled and rotated like the shape, then without the parts that change its norm or phase.
  const std::complex<double> factor = shape.dot(psi);  // shape · factor = psi
  if (!(std::abs(factor) > 0.0)) {
    result.shape = Eigen::VectorXcd::Zero(shape.size());
    return result;
  }
  Eigen::VectorXcd d = d_psi / factor;
  d -= shape * shape.dot(d).real();
  const std::complex<double> squares = (shape.transpose() * shape).value();
  const double turn = (shape.transpose() * d).value().imag() / std::max(std::abs(squares), 1e-12);
  result.shape = d - std::complex<double>(0.0, turn) * shape;
  return result;
}

}  // namespace

std::vector<PoleChange> pole_changes(const Observability& observability, const ShiftModels& models, std::size_t order,
                                     const SubspaceChange& change) {
  const OrderModel& model = models.orders[order];
  const Index n = model.order, m = models.r.cols(), rest = m - n, l = observability.n_outputs;
  const Eigen::VectorXd sigma = observability.singular_values.head(m);
  const ObservabilityChange d = observability_change(sigma, change.inner, n);
  const auto scale = d.outer_scale.asDiagonal();
  Eigen::MatrixXd p_up = change.up.topLeftCorner(n, n) * scale, p_down = change.down.topLeftCorner(n, n) * scale;
  Eigen::MatrixXd p_cross = change.cross.topLeftCorner(n, n) * scale, d_c = change.top.leftCols(n) * scale;
  if (rest > 0) {
    p_up += linalg::product(models.r.topRightCorner(n, rest), d.beyond);
    p_down += linalg::product(models.rotated.topRightCorner(n, rest), d.beyond);
    p_cross += linalg::product(models.cross.topRightCorner(n, rest), d.beyond);
    d_c += (observability.left.topRows(l).middleCols(n, rest) * sigma.tail(rest).cwiseSqrt().asDiagonal()) * d.beyond;
  }
  const Eigen::MatrixXd r = models.r.topLeftCorner(n, n);
  const auto upper = r.triangularView<Eigen::Upper>();
  Eigen::MatrixXd second = p_cross.transpose() - linalg::product(p_up, upper * model.a, true);
  upper.transpose().solveInPlace(second);
  Eigen::MatrixXd d_a = p_down - linalg::product(p_up, model.a) + second;
  upper.solveInPlace(d_a);

  std::vector<PoleChange> changes;
  for (std::size_t i = 0; i < model.poles.size(); ++i) {
    const Index at = model.kept[i];
    const Eigen::VectorXcd phi = model.right.col(at);
    const Eigen::VectorXcd g = model.left * (d_a * phi);
    Eigen::VectorXcd d_phi = g;
    for (Index k = 0; k < n; ++k) d_phi[k] = k == at ? std::complex<double>(0.0) : g[k] / (model.mu[at] - model.mu[k]);
    const Eigen::VectorXcd psi = model.c * phi, d_psi = d_c * phi + model.c * (model.right * d_phi);
    changes.push_back(changed_pole(model.mu[at], g[at], models.rate_Hz, psi, d_psi, model.poles[i].shape));
  }
  return changes;
}

}  // namespace twindeck::identification
