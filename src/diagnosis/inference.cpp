#include "diagnosis/inference.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/error.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kScaleDeviation = 10.0;  // of a free shape scale, relative: wide enough to cost nothing
constexpr double kUnbounded = 1e3;        // prior deviations

VectorXd pick(const VectorXd& from, const std::vector<int>& rows) { return from(rows); }

/// Nats that k unknowns with a uniform prior cost: ln of posterior width over prior width, never a gain.
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

}  // namespace

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
                           const VectorXd& g) const {
  const Candidate& candidate = *causes[which].candidate;
  MatrixXd out(g.size(), candidate.low.size());
  for (Index i = 0; i < candidate.low.size(); ++i) {
    std::vector<Cause> moved = causes;
    const double range = candidate.high[i] - candidate.low[i];
    double step = 1e-3 * range;
    if (moved[which].a[i] + step > candidate.high[i]) step = -step;
    moved[which].a[i] += step;
    const Prediction p = map_.predict(at, moved, false);
    out.col(i) = p.valid ? VectorXd((p.g - g) / step) : VectorXd(VectorXd::Zero(g.size()));
  }
  return out;
}

Fit Inference::fit(const std::vector<Cause>& causes, const VectorXd& start) const {
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
  // Magnitudes in units of twice their range about the start's middle: as good as uniform inside their hard bounds.
  VectorXd x0 = VectorXd::Zero(n + k), middle(k), width(k);
  if (start.size() >= n) x0.head(n) = start.head(n);
  Index at = 0;
  for (const Cause& cause : causes) {
    for (Index i = 0; i < cause.a.size(); ++i, ++at) {
      width[at] = 2.0 * (cause.candidate->high[i] - cause.candidate->low[i]);
      middle[at] = 0.5 * (cause.candidate->high[i] + cause.candidate->low[i]);
      x0[n + at] = (cause.a[i] - middle[at]) / width[at];
      box.lower[n + at] = -0.25;
      box.upper[n + at] = 0.25;
    }
  }
  const auto causes_at = [&](const VectorXd& x) {
    std::vector<Cause> moved = causes;
    Index p = 0;
    for (Cause& cause : moved)
      for (Index i = 0; i < cause.a.size(); ++i, ++p) cause.a[i] = middle[p] + width[p] * x[n + p];
    return moved;
  };
  const auto predict = [&](const VectorXd& x, VectorXd& g, MatrixXd* jacobian, MatrixXd* scales) {
    const FeatureMap::Base base = map_.base(x.head(n));
    const std::vector<Cause> moved = causes_at(x);
    const Prediction p = map_.predict(base, moved, jacobian != nullptr);
    if (!p.valid) return false;
    g = pick(p.g, training_);
    if (jacobian == nullptr) return true;
    jacobian->resize(g.size(), n + k);
    jacobian->leftCols(n) = p.jacobian(training_, Eigen::all);
    Index column = 0;
    for (std::size_t c = 0; c < moved.size(); ++c) {
      const MatrixXd slope = slopes(base, moved, c, p.g);
      for (Index i = 0; i < slope.cols(); ++i, ++column)
        jacobian->col(n + column) = width[column] * pick(slope.col(i), training_);
    }
    *scales = p.scales(training_, Eigen::all);
    return true;
  };
  Fit fit;
  fit.map = updating::joint_map(predict, y_, sigma_factor_, x0, box);
  fit.causes = causes_at(fit.map.x);
  fit.base = map_.base(fit.map.x.head(n));
  fit.all = map_.predict(fit.base, fit.causes, true);
  if (fit.map.jacobian.size() == 0 || !fit.all.valid) {
    fit.chi_squared = 1e300;
    return fit;
  }
  // Accepted causes are marginalised like x, or the next step would find their errors again.
  const MatrixXd& j = fit.map.jacobian;
  MatrixXd total = sigma_ + j * j.transpose();
  total += kScaleDeviation * kScaleDeviation * fit.map.scales * fit.map.scales.transpose();
  const Eigen::LLT<MatrixXd> factor(total);
  fit.total_factor = factor.matrixL();
  fit.log_determinant = 2.0 * fit.total_factor.diagonal().array().log().sum();
  const VectorXd r = y_ - fit.map.g + j * fit.map.x;
  fit.whitened = fit.total_factor.triangularView<Eigen::Lower>().solve(r);
  fit.chi_squared = fit.whitened.squaredNorm();
  fit.cause_jacobian =
      fit.total_factor.triangularView<Eigen::Lower>().solve(j.rightCols(k) * width.cwiseInverse().asDiagonal());
  return fit;
}

VectorXd Inference::signature(const Fit& base, const Candidate& candidate, const VectorXd& a) const {
  std::vector<Cause> causes = base.causes;
  causes.push_back({&candidate, a});
  const Prediction p = map_.predict(base.base, causes, false);
  if (!p.valid) return {};
  return base.total_factor.triangularView<Eigen::Lower>().solve(pick(p.g - base.all.g, training_));
}

ScreenTable Inference::screen_table(const Fit& base) const {
  std::vector<std::vector<VectorXd>> changes(candidates_.size());
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    for (const VectorXd& a : candidates_[i]->starts) {
      std::vector<Cause> causes = base.causes;
      causes.push_back({candidates_[i].get(), a});
      const Prediction p = map_.predict(base.base, causes, false);
      changes[i].push_back(p.valid ? VectorXd(p.g - base.all.g) : VectorXd());
    }
  }
  ScreenTable table;
  for (std::size_t i = 0; i < candidates_.size(); ++i) table.change[candidates_[i]->id()] = std::move(changes[i]);
  return table;
}

Scored Inference::screen(const Fit& base, const Candidate& candidate, const std::vector<VectorXd>* from_table) const {
  Scored best;
  best.candidate = &candidate;
  best.screen = -1e300;
  for (std::size_t i = 0; i < candidate.starts.size(); ++i) {
    VectorXd s;
    if (from_table == nullptr)
      s = signature(base, candidate, candidate.starts[i]);
    else if (i < from_table->size() && (*from_table)[i].size() > 0)
      s = base.total_factor.triangularView<Eigen::Lower>().solve(pick((*from_table)[i], training_));
    if (s.size() == 0) continue;
    const double along = s.dot(base.whitened), norm = s.squaredNorm();
    if (!(norm > 1e-12)) continue;
    const double scale = along / norm;
    const double t = !candidate.low.size() || scale <= 0.0 || scale > 3.0 ? 2.0 * along - norm : along * along / norm;
    if (t > best.screen) {
      best.screen = t;
      best.a = candidate.starts[i];
      best.signature = s;
    }
  }
  return best;
}

/// Candidates that are worth a new signature: those that the table shows best, and the best few of every family.
std::vector<const Candidate*> Inference::promising(const Fit& base, const SearchOptions& options) const {
  std::vector<const Candidate*> all;
  for (const auto& candidate : candidates_)
    if (std::none_of(base.causes.begin(), base.causes.end(),
                     [&](const Cause& cause) { return cause.candidate->id() == candidate->id(); }))
      all.push_back(candidate.get());
  if (table_ == nullptr) return all;
  std::vector<std::pair<double, const Candidate*>> ranked;
  for (const Candidate* candidate : all) {
    const auto known = table_->change.find(candidate->id());
    const double t = known == table_->change.end() ? 1e300 : screen(base, *candidate, &known->second).screen;
    ranked.emplace_back(0.5 * t + candidate->log_prior, candidate);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::map<std::string, std::size_t> of_family, starts;
  for (const Candidate* candidate : all) starts[candidate->hypothesis->id] += candidate->starts.size();
  std::vector<const Candidate*> chosen;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const Hypothesis& family = *ranked[i].second->hypothesis;
    // Families of few magnitudes, and those that leave the structure alone, cost little to compute anew.
    const bool cheap = family.measurement || starts[family.id] <= 32;
    if (of_family[family.id]++ < 2 || static_cast<int>(i) < options.tabled || cheap) chosen.push_back(ranked[i].second);
  }
  return chosen;
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
  double damping = 1e-3;
  for (int iteration = 0; iteration < 8 && k > 0; ++iteration) {
    for (Index i = 0; i < k; ++i) {
      double step = 2e-3 * range[i];
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
    for (int attempt = 0; attempt < 5 && !moved; ++attempt) {
      MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      VectorXd next = a + VectorXd(damped.ldlt().solve(gradient));
      next = next.cwiseMax(a - 0.35 * range).cwiseMin(a + 0.35 * range).cwiseMax(candidate.low).cwiseMin(candidate.high);
      const VectorXd there = signature(base, candidate, next);
      if (there.size() && cost(there) < chi_squared) {
        fall = chi_squared - cost(there);
        a = next;
        s = there;
        chi_squared = cost(s);
        damping *= 0.2;
        moved = true;
      } else {
        damping = std::max(damping * 8.0, 1e-2);
      }
    }
    if (!moved || fall < 0.02) break;
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

void Inference::refine(const Fit& base, Scored& scored) const {
  std::vector<Cause> causes = base.causes;
  causes.push_back({scored.candidate, scored.a});
  const Fit with = fit(causes, base.map.x);
  if (with.chi_squared > 1e299) return;
  scored.stage = 3;
  scored.a = with.causes.back().a;
  const Index k = scored.a.size();
  // The new cause's own part of Sigma_tot is an unknown with a prior, not scatter: evidence is taken without it.
  const MatrixXd& j = with.map.jacobian;
  MatrixXd total = sigma_ + j.leftCols(j.cols() - k) * j.leftCols(j.cols() - k).transpose();
  total += kScaleDeviation * kScaleDeviation * with.map.scales * with.map.scales.transpose();
  const Eigen::LLT<MatrixXd> factor(total);
  const MatrixXd lower = factor.matrixL();
  VectorXd x = with.map.x;
  x.tail(k).setZero();
  const VectorXd w = lower.triangularView<Eigen::Lower>().solve(y_ - with.map.g + j * x);
  const double log_det = 2.0 * lower.diagonal().array().log().sum();
  VectorXd width(k);
  for (Index i = 0; i < k; ++i) width[i] = 2.0 * (scored.candidate->high[i] - scored.candidate->low[i]);
  const MatrixXd slope = lower.triangularView<Eigen::Lower>().solve(j.rightCols(k) * width.cwiseInverse().asDiagonal());
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

std::vector<Scored> Inference::search(const Fit& base, const SearchOptions& options) const {
  // Candidates are held against the base one by one: the number of threads changes nothing.
  const std::vector<const Candidate*> chosen = promising(base, options);
  std::vector<Scored> all(chosen.size());
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t i = 0; i < chosen.size(); ++i) all[i] = screen(base, *chosen[i], nullptr);
  std::vector<Scored> found;
  for (Scored& scored : all)
    if (scored.signature.size() > 0) found.push_back(std::move(scored));
  const auto promise = [](const Scored& s) { return 0.5 * s.screen + s.candidate->log_prior; };
  std::stable_sort(found.begin(), found.end(), [&](const Scored& a, const Scored& b) { return promise(a) > promise(b); });
  std::set<std::string> families;
  int fitted = 0;
  std::vector<Scored*> list;
  for (Scored& scored : found) {
    const bool new_family = !families.contains(scored.candidate->hypothesis->id);
    const bool near = promise(scored) > promise(found.front()) - std::max(12.0, 0.3 * promise(found.front()));
    if (fitted < options.short_list || (near && fitted < options.longest_list) ||
        (new_family && scored.screen > options.family_screen)) {
      list.push_back(&scored);
      ++fitted;
      families.insert(scored.candidate->hypothesis->id);
    } else {
      scored.log_odds = -1e300;
    }
  }
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < list.size(); ++i) fit_linearised(base, *list[i]);
  const auto by_odds = [](const Scored& a, const Scored& b) { return a.log_odds > b.log_odds; };
  std::stable_sort(found.begin(), found.end(), by_odds);
  if (!found.empty() && found.front().log_odds > -2.0) {
    const double best = found.front().log_odds;
    for (int i = 0; i < options.most_refined && i < static_cast<int>(found.size()); ++i) {
      Scored& scored = found[static_cast<std::size_t>(i)];
      if (scored.log_odds > best - std::max(options.refine_within, 0.1 * best)) refine(base, scored);
    }
    std::stable_sort(found.begin(), found.end(), by_odds);
    // A refitted entry stands above its neighbours that were weighed on the linearised base alone: the nearest of its family
    // are refitted too, so that the place is chosen among equals.
    int deepened = 0;
    const Scored& first = found.front();
    const double near = first.log_odds - std::max(options.refine_within, 0.3 * first.log_odds);
    std::vector<Scored*> siblings;
    const auto rivals_at_a_damper = [&](const Scored& other) {  // what a damper can have wrong shows alike
      const auto lead = std::find_if(found.begin(), found.end(), [&](const Scored& s) {
        return s.stage == 3 && s.candidate->hypothesis->set.starts_with("damper") && (&s == &first || s.candidate->hypothesis->prior_weight > 1.0);
      });
      return lead != found.end() && other.stage < 3 && other.candidate->location == lead->candidate->location;
    };
    for (Scored& scored : found)
      if (rivals_at_a_damper(scored)) siblings.push_back(&scored);
      else if (deepened < options.deepened && scored.stage == 2 && scored.log_odds > near &&
          scored.candidate->hypothesis == first.candidate->hypothesis) {
        siblings.push_back(&scored);
        ++deepened;
      }
    for (Scored* sibling : siblings) {
      if (sibling->stage == 1) fit_linearised(base, *sibling);
      refine(base, *sibling);
    }
    std::stable_sort(found.begin(), found.end(), by_odds);
  }
  return found;
}

}  // namespace twindeck::diagnosis
