#include "diagnosis/inference/one_law.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRidge = 0.3;        // part of H added to a step: a class that the data do not determine moves slowly
constexpr double kLongestStep = 1.5;  // of ln tau
constexpr int kIterations = 25, kHalvings = 5;
constexpr double kSettled = 0.02;  // [nats] expected gain of a further step below which the search ends

double log_of_sum(const VectorXd& v, VectorXd& weight) {
  const double top = v.maxCoeff();
  weight = (v.array() - top).exp();
  const double sum = weight.sum();
  weight /= sum;
  return top + std::log(sum);
}

}  // namespace

ScalePrior prior_of_scale(const ActiveClass& active, double log_tau) {
  const double z = log_tau - std::log(active.scale), spread = active.spread;
  if (spread > 0.0) {
    const double log_norm = 0.5 * std::log(2.0 * std::numbers::pi) + std::log(spread);
    return {-0.5 * z * z / (spread * spread) - log_norm, -z / (spread * spread), 1.0 / (spread * spread)};
  }
  const double q = std::exp(2.0 * z) / 3.0;
  return {std::log(4.0 / (std::numbers::pi * std::sqrt(3.0) * active.scale)) + log_tau - 2.0 * std::log1p(q),
          1.0 - 4.0 * q / (1.0 + q), 8.0 * q / ((1.0 + q) * (1.0 + q))};
}

double log_width(const MatrixXd& precision, const VectorXd& range) {
  if (range.size() == 0) return 0.0;
  MatrixXd h = precision;
  h.diagonal().array() += 2.0 * std::numbers::pi / range.array().square();  // the posterior is no wider than the prior
  const VectorXd d = h.ldlt().vectorD();
  const double log_det = d.array().max(1e-300).log().sum();
  return std::min(
      0.5 * static_cast<double>(range.size()) * std::log(2.0 * std::numbers::pi) - 0.5 * log_det - range.array().log().sum(),
      0.0);
}

ErrorColumns ErrorColumns::of_covariance(MatrixXd covariance) {
  std::vector<Index> rows;  // that have errors
  for (Index r = 0; r < covariance.rows(); ++r)
    if (covariance(r, r) != 0.0) rows.push_back(r);
  const Index n = std::ssize(rows);
  const double rounding = std::numeric_limits<double>::epsilon() * covariance.trace();
  const MatrixXd lower =
      linalg::cholesky_factor(covariance(rows, rows) + rounding * static_cast<double>(n) * MatrixXd::Identity(n, n));
  MatrixXd columns = MatrixXd::Zero(covariance.rows(), n);
  if (lower.size() > 0) columns(rows, Eigen::all) = lower;
  return {std::move(covariance), std::move(columns)};
}

ErrorColumns ErrorColumns::of_columns(MatrixXd columns) {
  if (columns.cols() == 0) return {};
  if (columns.cols() > columns.rows()) return of_covariance(linalg::square(columns));
  MatrixXd covariance = linalg::square(columns);
  return {std::move(covariance), std::move(columns)};
}

MatrixXd covariance_at(MatrixXd sigma, const std::vector<ErrorColumns>& classes, const VectorXd& tau) {
  for (std::size_t c = 0; c < classes.size(); ++c)
    if (const double t = tau[static_cast<Index>(c)]; t > 0.0 && !classes[c].empty()) sigma += t * t * classes[c].covariance;
  return sigma;
}

MatrixXd covariance_at(const LawSystem& system, const VectorXd& tau) {
  return covariance_at(system.sigma, system.classes, tau);
}

/// A hypothesis evaluated at given scales of its active classes.
struct OneLaw::Look {
  VectorXd log_tau, tau;  // (n_active), (n_classes)
  Point point;
  double value = -1e300;  // ln (likelihood × prior)
  double chi_squared = 0.0;
  VectorXd shift, weight;
  MatrixXd solved;   // whitened r - s
  MatrixXd inverse;  // Sigma^-1 in the reached coordinates
  VectorXd gradient;
  MatrixXd curvature;
};

MatrixXd OneLaw::Point::whitened(MatrixXd z) const {
  z.topRows(lower.rows()) = linalg::lower_solve(lower, z.topRows(lower.rows()));
  return z;
}

OneLaw::Point OneLaw::at(const VectorXd& tau) const {
  Point out{tau, false, {}, -1e300};
  if (!coordinates_.exist()) return out;
  out.lower = linalg::cholesky_factor(covariance_at(coordinates_.sigma(), coordinates_.classes(), tau));
  out.exists = out.lower.rows() == coordinates_.sigma().rows();
  out.log_determinant = coordinates_.log_determinant() + 2.0 * out.lower.diagonal().array().log().sum();
  return out;
}

LawHypothesis OneLaw::in_coordinates(LawHypothesis hypothesis) const {
  if (!coordinates_.exist()) return hypothesis;
  hypothesis.left = coordinates_.of(hypothesis.left);
  if (hypothesis.slopes.cols() > 0) hypothesis.slopes = coordinates_.of(hypothesis.slopes);
  return hypothesis;
}

OneLaw::Look OneLaw::look(const LawHypothesis& hypothesis, const VectorXd& log_tau) const {
  Look out;
  out.log_tau = log_tau;
  out.tau = VectorXd::Zero(classes());
  double prior = system_.log_prior;
  for (std::size_t k = 0; k < hypothesis.active.size(); ++k) {
    const double t = log_tau[static_cast<Index>(k)];
    out.tau[hypothesis.active[k].index] = std::exp(t);
    prior += prior_of_scale(hypothesis.active[k], t).log_density;
  }
  out.point = at(out.tau);
  if (!out.point.exists) return out;
  out.solved = out.point.whitened(hypothesis.left);
  double width = 0.0;
  if (hypothesis.slopes.cols() > 0) {
    const MatrixXd slopes = out.point.whitened(hypothesis.slopes);
    MatrixXd products = linalg::product(slopes, slopes, true);
    width = log_width(products, hypothesis.high - hypothesis.low);
    products.diagonal().array() += 1e-12 * (1.0 + products.diagonal().array().abs());
    out.shift = products.ldlt().solve(slopes.transpose() * out.solved.col(0));
    out.shift = out.shift.cwiseMax(hypothesis.low).cwiseMin(hypothesis.high);
    out.solved.col(0) -= slopes * out.shift;
  }
  const VectorXd chi_squared = out.solved.colwise().squaredNorm();
  out.chi_squared = chi_squared.minCoeff();
  const double log_likelihood = log_of_sum(hypothesis.log_weight - 0.5 * chi_squared, out.weight);
  out.value = log_likelihood - 0.5 * out.point.log_determinant + width + prior;
  return out;
}

void OneLaw::slope_of(const LawHypothesis& hypothesis, Look& look) const {
  const auto count = static_cast<Index>(hypothesis.active.size());
  look.inverse = linalg::inverse_of_factored(look.point.lower);
  const MatrixXd alpha = linalg::lower_solve(look.point.lower, look.solved.topRows(coordinates_.sigma().rows()), true);
  look.gradient.resize(count);
  std::vector<MatrixXd> along;  // L^-1 P_c alpha, each column times the square root of its weight
  for (Index k = 0; k < count; ++k) {
    const ActiveClass& active = hypothesis.active[static_cast<std::size_t>(k)];
    const MatrixXd& square = coordinates_.classes()[static_cast<std::size_t>(active.index)].covariance;
    const double tau = look.tau[active.index];
    MatrixXd moved = linalg::product(square, alpha);
    const VectorXd power = moved.cwiseProduct(alpha).colwise().sum();
    look.gradient[k] = tau * tau * (power.dot(look.weight) - square.cwiseProduct(look.inverse).sum()) +
                       prior_of_scale(active, look.log_tau[k]).slope;
    moved *= look.weight.cwiseSqrt().asDiagonal();
    along.push_back(linalg::lower_solve(look.point.lower, std::move(moved)));
  }
  look.curvature =
      with_prior(hypothesis, look, [&](std::size_t k, std::size_t l) { return along[k].cwiseProduct(along[l]).sum(); });
}

MatrixXd OneLaw::expected_curvature(const LawHypothesis& hypothesis, const Look& look) const {
  std::vector<MatrixXd> whitened;  // L^-1 D_c
  for (const ActiveClass& active : hypothesis.active)
    whitened.push_back(
        linalg::lower_solve(look.point.lower, coordinates_.classes()[static_cast<std::size_t>(active.index)].columns));
  return with_prior(hypothesis, look, [&](std::size_t k, std::size_t l) {
    return linalg::product(whitened[k], whitened[l], true).squaredNorm();
  });
}

MatrixXd OneLaw::with_prior(const LawHypothesis& hypothesis, const Look& look,
                            const std::function<double(std::size_t, std::size_t)>& information) {
  const std::size_t count = hypothesis.active.size();
  MatrixXd out(count, count);
  for (std::size_t k = 0; k < count; ++k) {
    const ActiveClass& active = hypothesis.active[k];
    const double tau = look.tau[active.index];
    for (std::size_t l = 0; l <= k; ++l) {
      const double other = look.tau[hypothesis.active[l].index];
      const auto i = static_cast<Index>(k), j = static_cast<Index>(l);
      out(i, j) = out(j, i) = 2.0 * tau * tau * other * other * information(k, l);
    }
    const auto own = static_cast<Index>(k);
    out(own, own) += prior_of_scale(active, look.log_tau[own]).curvature;
  }
  return out;
}

double OneLaw::log_posterior(const LawHypothesis& hypothesis, const VectorXd& tau) const {
  VectorXd log_tau(std::ssize(hypothesis.active));
  for (Index k = 0; k < log_tau.size(); ++k) log_tau[k] = std::log(tau[hypothesis.active[static_cast<std::size_t>(k)].index]);
  return look(in_coordinates(hypothesis), log_tau).value;
}

LawEvidence OneLaw::scored(const LawHypothesis& in_rows, const VectorXd& start) const {
  const LawHypothesis hypothesis = in_coordinates(in_rows);
  const auto count = static_cast<Index>(hypothesis.active.size());
  VectorXd log_tau(count);
  for (Index k = 0; k < count; ++k) {
    const ActiveClass& active = hypothesis.active[static_cast<std::size_t>(k)];
    log_tau[k] = std::log(start[active.index] > 0.0 ? start[active.index] : active.scale);
  }
  Look now = look(hypothesis, log_tau);
  LawEvidence out;
  out.tau = out.deviation = VectorXd::Zero(classes());
  if (!now.point.exists) return out;
  slope_of(hypothesis, now);
  for (int i = 0; i < kIterations && !out.converged; ++i) {
    MatrixXd damped = now.curvature;
    damped.diagonal().array() += kRidge;
    VectorXd step = damped.ldlt().solve(now.gradient);
    out.converged = 0.5 * now.gradient.dot(step) < kSettled;
    if (out.converged) break;
    step = step.cwiseMax(-kLongestStep).cwiseMin(kLongestStep);
    bool moved = false;
    for (int halving = 0; halving < kHalvings && !moved; ++halving, step *= 0.5) {
      Look next = look(hypothesis, now.log_tau + step);
      moved = next.value > now.value;
      if (moved) now = std::move(next);
    }
    if (!moved) break;
    slope_of(hypothesis, now);
  }
  const MatrixXd lower = linalg::cholesky_factor(expected_curvature(hypothesis, now));
  if (count > 0 && lower.size() == 0) return out;
  const double log_volume = 0.5 * static_cast<double>(count) * std::log(2.0 * std::numbers::pi) -
                            (count > 0 ? lower.diagonal().array().log().sum() : 0.0);
  out.log_evidence = now.value + log_volume;
  out.chi_squared = now.chi_squared;
  out.tau = now.tau;
  out.shift = now.shift;
  out.weight = now.weight;
  if (count > 0) {
    const MatrixXd inverse = linalg::lower_solve(lower, MatrixXd::Identity(count, count));
    for (Index k = 0; k < count; ++k)
      out.deviation[hypothesis.active[static_cast<std::size_t>(k)].index] = inverse.col(k).norm();
  }
  return out;
}

}  // namespace twindeck::diagnosis
