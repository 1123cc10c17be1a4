#include "diagnosis/inference.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kScaleDeviation = 10.0;  // of a free shape scale, relative; wide enough to have no influence
constexpr double kUnbounded = 1e3;        // prior deviations
constexpr double kScaledEnd = 0.25;       // bounds of a magnitude in units of twice its range
constexpr double kSlopeStep = 1e-3;       // step of differences, as part of a magnitude's range

VectorXd pick(const VectorXd& from, const std::vector<int>& rows) { return from(rows); }

/// Lower Cholesky factor of sigma + J J' + the variance of the free scales.
MatrixXd total_factor_of(const MatrixXd& sigma, const Eigen::Ref<const MatrixXd>& jacobian, const MatrixXd& scales) {
  MatrixXd all(jacobian.rows(), jacobian.cols() + scales.cols());
  all << jacobian, kScaleDeviation * scales;
  return linalg::cholesky_factor(sigma + linalg::square(all));
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

/// Change of rows by a small step. Rows of modes that the step pairs with another mode of the model would jump, and are 0.
VectorXd change_of_same_modes(const FeatureMap& map, const Prediction& from, const Prediction& to) {
  VectorXd change = change_between(from, to);
  for (std::size_t m = 0; m < from.paired.size(); ++m) {
    if (from.paired[m] == to.paired[m]) continue;
    const MeasuredMode& mode = map.measured_modes()[m];
    for (const int row : {mode.frequency, mode.damping})
      if (row >= 0) change[row] = 0.0;
    change(mode.real_rows).setZero();
    change(mode.imag_rows).setZero();
  }
  return change;
}

}  // namespace

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
    const double range = candidate.high[i] - candidate.low[i];
    double step = kSlopeStep * range;
    if (causes[which].a[i] + step > candidate.high[i]) step = -step;
    const auto stepped = [&](double by) {
      std::vector<Cause> moved = causes;
      moved[which].a[i] += by;
      return map_.predict(at, moved, false);
    };
    Prediction p = stepped(step);
    if (p.valid && p.paired != here.paired)
      if (Prediction back = stepped(-step); back.valid && back.paired == here.paired) {
        p = std::move(back);
        step = -step;
      }
    out.col(i) = p.valid ? VectorXd(change_of_same_modes(map_, here, p) / step) : VectorXd(VectorXd::Zero(here.g.size()));
  }
  return out;
}

Fit Inference::fitted(const std::vector<Cause>& causes, const VectorXd& start, bool moves) const {
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
  x0.head(n) = start.size() >= n ? start.head(n) : map_.standing();
  const Magnitudes magnitudes(causes, k);
  x0.tail(k) = magnitudes.scaled(causes);
  box.lower.tail(k).setConstant(-kScaledEnd);
  box.upper.tail(k).setConstant(kScaledEnd);
  // An accepted step is predicted twice, without and with derivatives. Both use the same solved states.
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
  if (!moves) options.max_iterations = 0;
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
  // Accepted causes are marginalised like x. Otherwise the next step would find their errors again.
  const MatrixXd& j = fit.map.jacobian;
  fit.total_factor = total_factor_of(sigma_, j, fit.map.scales);
  if (fit.total_factor.size() == 0) {  // derivatives are not finite
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

std::vector<VectorXd> Inference::starts_at(const Fit& base, const Candidate& candidate) const {
  std::vector<VectorXd> starts = candidate.starts;
  if (candidate.tuned < 0 || !base.all.valid) return starts;
  const auto u = static_cast<Index>(candidate.tuned);
  const auto& modes = map_.measured_modes();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Tuning& tuning = candidate.tuning[i];
    for (std::size_t m = 0; m < modes.size(); ++m) {
      if (tuning.mode.empty() || modes[m].condition != tuning.condition || modes[m].label != tuning.mode) continue;
      const double f = tuning.factor * base.all.frequency_Hz[m];
      starts[i][u] =
          std::clamp(candidate.log[static_cast<std::size_t>(u)] ? std::log(f) : f, candidate.low[u], candidate.high[u]);
    }
  }
  return starts;
}

std::vector<Inference::Tried> Inference::tried(const Fit& base, const Candidate& candidate) const {
  std::vector<Tried> out;
  for (const VectorXd& a : starts_at(base, candidate))
    if (VectorXd of_start = change(base, candidate, a); of_start.size() > 0) out.push_back({a, std::move(of_start)});
  return out;
}

}  // namespace twindeck::diagnosis
