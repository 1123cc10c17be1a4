#include "diagnosis/inference.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kScaleDeviation = 10.0;  // of a free shape scale, relative: wide enough to cost nothing
constexpr double kUnbounded = 1e3;        // prior deviations
constexpr double kScaledEnd = 0.25;       // of magnitudes in units of twice their range: its ends
constexpr double kSlopeStep = 1e-3;       // of a magnitude's range: for derivatives of a fit by differences
constexpr double kSearchStep = 2e-3;      // the same in the search, where the base is linearised
constexpr double kLongestStep = 0.35;     // of a magnitude's range in one step on the linearised base
constexpr double kStartDamping = 1e-3, kDampingFall = 0.2, kDampingRise = 8.0, kDampingAgain = 1e-2;  // Levenberg-Marquardt
constexpr int kLinearisedSteps = 8, kLinearisedAttempts = 5;  // on the linearised base: the joint fit goes on from there
constexpr double kLeastFall = 0.02;                           // of chi² in one step: less decides nothing

VectorXd pick(const VectorXd& from, const std::vector<int>& rows) { return from(rows); }

/// Lower factor of sigma + J J' + the scales' share.
MatrixXd total_factor_of(const MatrixXd& sigma, const Eigen::Ref<const MatrixXd>& jacobian, const MatrixXd& scales) {
  MatrixXd all(jacobian.rows(), jacobian.cols() + scales.cols());
  all << jacobian, kScaleDeviation * scales;
  return linalg::cholesky_factor(sigma + linalg::product(all, all.transpose()));
}

/// Magnitudes of causes in units of twice their range about its middle, where the prior of deviation 1 is as good as uniform
/// inside the hard bounds. One entry a coordinate, cause by cause (n_coordinates).
struct Magnitudes {
  VectorXd middle, width;

  Magnitudes(const std::vector<Cause>& causes, Index count) : middle(count), width(count) {
    Index at = 0;
    for (const Cause& cause : causes)
      for (Index i = 0; i < cause.a.size(); ++i, ++at) {
        width[at] = 2.0 * (cause.candidate->high[i] - cause.candidate->low[i]);
        middle[at] = 0.5 * (cause.candidate->high[i] + cause.candidate->low[i]);
      }
  }
  [[nodiscard]] VectorXd scaled(const std::vector<Cause>& causes) const {
    VectorXd out(width.size());
    Index at = 0;
    for (const Cause& cause : causes)
      for (Index i = 0; i < cause.a.size(); ++i, ++at) out[at] = (cause.a[i] - middle[at]) / width[at];
    return out;
  }
  [[nodiscard]] std::vector<Cause> at(const std::vector<Cause>& causes, const VectorXd& scaled) const {
    std::vector<Cause> moved = causes;
    Index p = 0;
    for (Cause& cause : moved)
      for (Index i = 0; i < cause.a.size(); ++i, ++p) cause.a[i] = middle[p] + width[p] * scaled[p];
    return moved;
  }
};

}  // namespace

double ockham(const MatrixXd& precision, const Candidate& candidate) {
  const Index k = candidate.low.size();
  if (k == 0) return 0.0;
  MatrixXd h = precision;
  double log_range = 0.0;
  for (Index i = 0; i < k; ++i) {
    const double range = candidate.high[i] - candidate.low[i];
    log_range += std::log(range);
    h(i, i) += 2.0 * std::numbers::pi / (range * range);  // no narrower than the data make it, no wider than the prior
  }
  const VectorXd d = h.ldlt().vectorD();
  double log_det = 0.0;
  for (Index i = 0; i < k; ++i) log_det += std::log(std::max(d[i], 1e-300));
  return std::min(0.5 * static_cast<double>(k) * std::log(2.0 * std::numbers::pi) - 0.5 * log_det - log_range, 0.0);
}

double chi_squared_tail(double x, double dof) {
  // Regularised upper incomplete gamma function Q(dof/2, x/2): series or continued fraction (Abramowitz and Stegun 6.5).
  const double a = 0.5 * dof, z = 0.5 * x;
  if (z <= 0.0) return 1.0;
  const double front = std::exp(-z + a * std::log(z) - std::lgamma(a));
  if (z < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && std::abs(term) > 1e-16 * sum; ++n) sum += term *= z / (a + n);
    return std::clamp(1.0 - front * sum, 0.0, 1.0);
  }
  double b = z + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    const double change = d * c;
    h *= change;
    if (std::abs(change - 1.0) < 1e-15) break;
  }
  return front * h;
}

Inference::Inference(const FeatureMap& map, const std::vector<std::unique_ptr<Candidate>>& candidates)
    : map_(map), candidates_(candidates) {
  for (std::size_t r = 0; r < map.features().rows.size(); ++r)
    (map.features().rows[r].held_out ? held_out_ : training_).push_back(static_cast<int>(r));
  if (training_.empty()) throw InputError({"", 0, "held_out"}, "no row is left for the fit", "hold fewer rows out");
  y_ = pick(map.values(), training_);
  sigma_ = map.covariance()(training_, training_);
  const Eigen::LLT<MatrixXd> factor(sigma_);
  if (factor.info() != Eigen::Success) {
    throw InputError({"", 0, "covariance"}, "the covariance of the rows is not positive definite",
                     "check covariance.npy, or leave it out and give std");
  }
  sigma_factor_ = factor.matrixL();
  const std::set<int> training(training_.begin(), training_.end());
  for (const MeasuredMode& mode : map.measured_modes())
    if (!mode.real_rows.empty() && training.contains(mode.real_rows.front()))
      training_scales_ += mode.imag_rows.empty() ? 1 : 2;
}

MatrixXd Inference::slopes(const FeatureMap::Base& at, const std::vector<Cause>& causes, std::size_t which,
                           const Prediction& here) const {
  const Candidate& candidate = *causes[which].candidate;
  MatrixXd out(here.g.size(), candidate.low.size());
  for (Index i = 0; i < candidate.low.size(); ++i) {
    std::vector<Cause> moved = causes;
    const double range = candidate.high[i] - candidate.low[i];
    double step = kSlopeStep * range;
    if (moved[which].a[i] + step > candidate.high[i]) step = -step;
    moved[which].a[i] += step;
    const Prediction p = map_.predict(at, moved, false);
    out.col(i) = p.valid ? VectorXd(change_between(here, p) / step) : VectorXd(VectorXd::Zero(here.g.size()));
  }
  return out;
}

Fit Inference::fit(const std::vector<Cause>& causes, const VectorXd& start, int iterations) const {
  const auto n = static_cast<Index>(map_.nuisances().size());
  Index k = 0;
  for (const Cause& cause : causes) k += cause.a.size();
  updating::Box box;
  box.lower = VectorXd::Constant(n + k, -kUnbounded);
  box.upper = VectorXd::Constant(n + k, kUnbounded);
  for (Index j = 0; j < n; ++j) {
    box.lower[j] = std::max(map_.nuisances()[static_cast<std::size_t>(j)].lower, -kUnbounded);
    box.upper[j] = std::min(map_.nuisances()[static_cast<std::size_t>(j)].upper, kUnbounded);
  }
  VectorXd x0 = VectorXd::Zero(n + k);
  if (start.size() >= n) x0.head(n) = start.head(n);
  const Magnitudes magnitudes(causes, k);
  x0.tail(k) = magnitudes.scaled(causes);
  box.lower.tail(k).setConstant(-kScaledEnd);
  box.upper.tail(k).setConstant(kScaledEnd);
  // A step that is taken is predicted twice, without derivatives and with them: both share the solved states.
  FeatureMap::Base base;
  const auto predict = [&](const VectorXd& x, VectorXd& g, MatrixXd* jacobian, MatrixXd* scales) {
    if (base.x.size() != n || base.x != x.head(n)) {
      base = map_.base(x.head(n));
      base.keeps = true;
    }
    const std::vector<Cause> moved = magnitudes.at(causes, x.tail(k));
    const Prediction p = map_.predict(base, moved, jacobian != nullptr);
    if (!p.valid) return false;
    g = pick(p.g, training_);
    if (jacobian == nullptr) return true;
    jacobian->resize(g.size(), n + k);
    jacobian->leftCols(n) = p.jacobian(training_, Eigen::all);
    Index column = 0;
    for (std::size_t c = 0; c < moved.size(); ++c) {
      const MatrixXd slope = slopes(base, moved, c, p);
      for (Index i = 0; i < slope.cols(); ++i, ++column)
        jacobian->col(n + column) = magnitudes.width[column] * pick(slope.col(i), training_);
    }
    *scales = p.scales(training_, Eigen::all);
    return true;
  };
  Fit fit;
  updating::JointMapOptions options;
  if (iterations != 0) options.max_iterations = std::max(iterations, 0);
  fit.map = updating::joint_map(predict, y_, sigma_factor_, x0, box, options);
  fit.causes = magnitudes.at(causes, fit.map.x.tail(k));
  fit.base = map_.base(fit.map.x.head(n));
  fit.all = map_.predict(fit.base, fit.causes, true);
  if (fit.map.jacobian.size() == 0 || !fit.all.valid)
    fit.chi_squared = kNotFitted;
  else
    marginalise(magnitudes.width, fit);
  return fit;
}

void Inference::marginalise(const VectorXd& width, Fit& fit) const {
  // Accepted causes are marginalised like x, or the next step would find their errors again.
  const MatrixXd& j = fit.map.jacobian;
  fit.total_factor = total_factor_of(sigma_, j, fit.map.scales);
  if (fit.total_factor.size() == 0) {  // derivatives that are no numbers
    fit.chi_squared = kNotFitted;
    return;
  }
  fit.log_determinant = 2.0 * fit.total_factor.diagonal().array().log().sum();
  const VectorXd r = y_ - fit.map.g + j * fit.map.x;
  fit.whitened = fit.total_factor.triangularView<Eigen::Lower>().solve(r);
  fit.chi_squared = fit.whitened.squaredNorm();
  fit.cause_jacobian = linalg::lower_solve(fit.total_factor, j.rightCols(width.size()) * width.cwiseInverse().asDiagonal());
}

VectorXd Inference::change(const Fit& base, const Candidate& candidate, const VectorXd& a) const {
  std::vector<Cause> causes = base.causes;
  causes.push_back({&candidate, a});
  const Prediction p = map_.predict(base.base, causes, false);
  return p.valid ? change_between(base.all, p) : VectorXd();
}

VectorXd Inference::whitened(const Fit& base, const VectorXd& change) const {
  if (change.size() == 0) return {};
  return base.total_factor.triangularView<Eigen::Lower>().solve(pick(change, training_));
}

VectorXd Inference::signature(const Fit& base, const Candidate& candidate, const VectorXd& a) const {
  return whitened(base, change(base, candidate, a));
}

void Inference::fit_linearised(const Fit& base, Scored& scored) const {
  const Candidate& candidate = *scored.candidate;
  const Index k = candidate.low.size();
  scored.stage = 2;
  VectorXd a = scored.a, s = scored.signature;
  const auto cost = [&](const VectorXd& signature) { return (base.whitened - signature).squaredNorm(); };
  double chi_squared = cost(s);
  const VectorXd range = candidate.high - candidate.low;
  MatrixXd slope(s.size(), k);
  double damping = kStartDamping;
  for (int iteration = 0; iteration < kLinearisedSteps && k > 0; ++iteration) {
    for (Index i = 0; i < k; ++i) {
      double step = kSearchStep * range[i];
      if (a[i] + step > candidate.high[i]) step = -step;
      VectorXd moved = a;
      moved[i] += step;
      const VectorXd there = signature(base, candidate, moved);
      slope.col(i) = there.size() ? VectorXd((there - s) / step) : VectorXd(VectorXd::Zero(s.size()));
    }
    MatrixXd normal = slope.transpose() * slope;
    const VectorXd gradient = slope.transpose() * (base.whitened - s);
    normal.diagonal() += (1e-9 / range.array().square()).matrix();
    bool moved = false;
    double fall = 0.0;
    for (int attempt = 0; attempt < kLinearisedAttempts && !moved; ++attempt) {
      MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      VectorXd next = a + VectorXd(damped.ldlt().solve(gradient));
      next = next.cwiseMax(a - kLongestStep * range)
                 .cwiseMin(a + kLongestStep * range)
                 .cwiseMax(candidate.low)
                 .cwiseMin(candidate.high);
      const VectorXd there = signature(base, candidate, next);
      if (there.size() && cost(there) < chi_squared) {
        fall = chi_squared - cost(there);
        a = next;
        s = there;
        chi_squared = cost(s);
        damping *= kDampingFall;
        moved = true;
      } else {
        damping = std::max(damping * kDampingRise, kDampingAgain);
      }
    }
    if (!moved || fall < kLeastFall) break;
  }
  scored.a = a;
  scored.signature = s;
  scored.chi_squared = scored.remaining = chi_squared;
  const MatrixXd precision = slope.transpose() * slope;
  scored.log_odds = 0.5 * (base.chi_squared - chi_squared) + ockham(precision, candidate) + candidate.log_prior;
  if (k > 0) {
    MatrixXd h = precision;
    h.diagonal() += (12.0 / range.array().square()).matrix();
    scored.a_covariance = h.ldlt().solve(MatrixXd::Identity(k, k));
  }
}

void Inference::refine(const Fit& base, Scored& scored, const VectorXd& start, int iterations) const {
  std::vector<Cause> causes = base.causes;
  causes.push_back({scored.candidate, scored.a});
  const Fit with = fit(causes, start, iterations);
  if (!with.made()) return;
  scored.stage = iterations > 0 && !with.map.status.converged ? 2 : 3;
  scored.a = with.causes.back().a;
  scored.x = with.map.x.head(static_cast<Index>(map_.nuisances().size()));
  if (const VectorXd here = signature(base, *scored.candidate, scored.a); here.size() > 0) scored.signature = here;
  const Index k = scored.a.size();
  // The new cause's own part of Sigma_tot is an unknown with a prior, not scatter: evidence is taken without it.
  const MatrixXd& j = with.map.jacobian;
  const MatrixXd lower = total_factor_of(sigma_, j.leftCols(j.cols() - k), with.map.scales);
  if (lower.size() == 0) return;
  VectorXd x = with.map.x;
  x.tail(k).setZero();
  const VectorXd w = lower.triangularView<Eigen::Lower>().solve(y_ - with.map.g + j * x);
  const double log_det = 2.0 * lower.diagonal().array().log().sum();
  VectorXd width(k);
  for (Index i = 0; i < k; ++i) width[i] = 2.0 * (scored.candidate->high[i] - scored.candidate->low[i]);
  const MatrixXd slope = linalg::lower_solve(lower, j.rightCols(k) * width.cwiseInverse().asDiagonal());
  const MatrixXd precision = slope.transpose() * slope;
  scored.chi_squared = scored.remaining = w.squaredNorm();
  scored.log_odds = 0.5 * (base.chi_squared + base.log_determinant - scored.chi_squared - log_det) +
                    ockham(precision, *scored.candidate) + scored.candidate->log_prior;
  if (k > 0) {
    MatrixXd h = precision;
    for (Index i = 0; i < k; ++i) h(i, i) += 48.0 / (width[i] * width[i]);
    scored.a_covariance = h.ldlt().solve(MatrixXd::Identity(k, k));
  }
}

}  // namespace twindeck::diagnosis
