#include "diagnosis/inference/form_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Groups of kinks that products couple, each by the positions of its members.
std::vector<std::vector<int>> coupled_groups(const MatrixXd& gram) {
  const auto n = static_cast<int>(gram.rows());
  std::vector<int> group(static_cast<std::size_t>(n), -1);
  std::vector<std::vector<int>> out;
  for (int first = 0; first < n; ++first) {
    if (group[static_cast<std::size_t>(first)] >= 0) continue;
    std::vector<int> members = {first};
    group[static_cast<std::size_t>(first)] = static_cast<int>(out.size());
    for (std::size_t at = 0; at < members.size(); ++at)
      for (int j = 0; j < n; ++j) {
        if (group[static_cast<std::size_t>(j)] >= 0) continue;
        const double least = 1e-13 * std::sqrt(gram(members[at], members[at]) * gram(j, j));
        if (!(std::abs(gram(members[at], j)) > least)) continue;
        group[static_cast<std::size_t>(j)] = static_cast<int>(out.size());
        members.push_back(j);
      }
    out.push_back(members);
  }
  return out;
}

double log_diagonal(const MatrixXd& lower) { return lower.diagonal().array().log().sum(); }

MatrixXd factor_of(const MatrixXd& symmetric) {
  MatrixXd lower = linalg::cholesky_factor(symmetric);
  TWINDECK_ASSERT(lower.size() == symmetric.size());  // identity plus a Gram matrix, of columns that can_be_weighed
  return lower;
}

}  // namespace

double Quadratic::remaining(Index s, double t) const {
  return s < 0 ? chi_squared : chi_squared - 2.0 * t * along[s] + t * t * square[s];
}

double Quadratic::log_density(Index s, double t) const { return -0.5 * (remaining(s, t) + log_determinant); }

double log_sum(const std::vector<double>& v) {
  if (v.empty()) return -1e300;
  const double top = *std::max_element(v.begin(), v.end());
  double sum = 0.0;
  for (const double x : v) sum += std::exp(x - top);
  return top + std::log(sum);
}

bool can_be_weighed(const FormSystem& system) {
  constexpr double kLargest = 1e6;
  const VectorXd deviation = system.sigma_factor.rowwise().norm();
  const auto sound = [&](const MatrixXd& m) {
    return m.size() == 0 || (m.allFinite() && (m.cwiseAbs().rowwise().maxCoeff().array() < kLargest * deviation.array()).all());
  };
  return sound(system.fixed) && sound(system.scatter) && sound(system.shape) && sound(system.kinks) && sound(system.signatures);
}

FormEvidence::FormEvidence(const FormSystem& system, const ScaleGrid& grid)
    : grid_(grid),
      fixed_(system.fixed.cols()),
      scatter_(system.scatter.cols()),
      frequency_(system.frequency.cols()),
      shape_(system.shape.cols()),
      all_products_(system.all_products) {
  const Index n = system.residual.size(), signatures = system.signatures.cols();
  Index m = fixed_ + scatter_ + frequency_ + shape_;
  for (const ChangeColumns& change : system.change) {
    change_first_.push_back(m);
    change_count_.push_back(change.columns.cols());
    asked_.push_back(change.signatures);
    m += change.columns.cols();
  }
  MatrixXd columns(n, m + system.kinks.cols() + 1 + signatures);
  columns.leftCols(fixed_ + scatter_ + frequency_ + shape_) << system.fixed, system.scatter, system.frequency, system.shape;
  for (std::size_t c = 0; c < system.change.size(); ++c)
    columns.middleCols(change_first_[c], change_count_[c]) = system.change[c].columns;
  columns.middleCols(m, system.kinks.cols()) = system.kinks;
  columns.col(m + system.kinks.cols()) = system.residual;
  columns.rightCols(signatures) = system.signatures;
  columns = linalg::lower_solve(system.sigma_factor, std::move(columns));
  log_determinant_ = 2.0 * log_diagonal(system.sigma_factor);
  every_.resize(static_cast<std::size_t>(signatures));
  std::iota(every_.begin(), every_.end(), 0);
  whitened_ = columns.rightCols(1 + signatures);
  const auto unknowns = columns.leftCols(m), kinks = columns.middleCols(m, system.kinks.cols());
  const MatrixXd gram = linalg::product(unknowns, unknowns, true), right = linalg::product(unknowns, whitened_, true);
  const MatrixXd kink_gram = linalg::product(kinks, kinks, true), kink_unknowns = linalg::product(kinks, unknowns, true),
                 kink_right = linalg::product(kinks, whitened_, true);
  const auto groups = coupled_groups(kink_gram);
  for (const double scale : grid_.shape) {
    Eliminated out{gram, right, MatrixXd::Zero(kinks.cols(), whitened_.cols()), 0.0};
    MatrixXd taken(kinks.cols(), m);
    for (const std::vector<int>& group : groups) {
      MatrixXd own = scale * scale * kink_gram(group, group);
      own.diagonal().array() += 1.0;
      const MatrixXd lower = factor_of(own);
      out.log_determinant += 2.0 * log_diagonal(lower);
      taken(group, Eigen::all) = scale * linalg::lower_solve(lower, kink_unknowns(group, Eigen::all));
      out.removed(group, Eigen::all) = scale * linalg::lower_solve(lower, kink_right(group, Eigen::all));
    }
    out.gram -= linalg::product(taken, taken, true);
    out.right -= linalg::product(taken, out.removed, true);
    eliminated_.push_back(std::move(out));
  }
}

Quadratic FormEvidence::quadratic(double log_determinant, const MatrixXd& here, const MatrixXd& change, const MatrixXd& kinks,
                                  const std::vector<int>& signatures) const {
  // Columns of `here` and `kinks` are residual and all signatures; of `change` residual and the asked ones.
  Quadratic out;
  out.log_determinant = log_determinant;
  const auto dot = [&](Index i, Index j, Index i_asked, Index j_asked) {
    double value = whitened_.col(i).dot(whitened_.col(j)) - here.col(i).dot(here.col(j)) - kinks.col(i).dot(kinks.col(j));
    if (change.size() > 0) value -= change.col(i_asked).dot(change.col(j_asked));
    return value;
  };
  out.chi_squared = dot(0, 0, 0, 0);
  const Index n = std::ssize(signatures);
  out.along.resize(n);
  out.square.resize(n);
  if (all_products_) out.products.resize(n, n);
  for (Index k = 0; k < n; ++k) {
    const Index at = 1 + signatures[static_cast<std::size_t>(k)];
    out.along[k] = dot(at, 0, 1 + k, 0);
    out.square[k] = dot(at, at, 1 + k, 1 + k);
    for (Index l = 0; all_products_ && l < n; ++l)
      out.products(k, l) = dot(at, 1 + signatures[static_cast<std::size_t>(l)], 1 + k, 1 + l);
  }
  return out;
}

AtScales FormEvidence::at(const ScalePoint& point, int contrast) const {
  const Eliminated& e = eliminated_[static_cast<std::size_t>(point.shape)];
  const Index m = fixed_ + scatter_ + frequency_ + shape_;
  VectorXd d(m);
  d << VectorXd::Ones(fixed_), VectorXd::Constant(scatter_, point.scatter),
      VectorXd::Constant(frequency_, grid_.frequency[point.frequency]), VectorXd::Constant(shape_, grid_.shape[point.shape]);
  MatrixXd inner = d.asDiagonal() * e.gram.topLeftCorner(m, m) * d.asDiagonal();
  inner.diagonal().array() += 1.0;
  const MatrixXd lower = factor_of(inner);
  const MatrixXd here = linalg::lower_solve(lower, d.asDiagonal() * e.right.topRows(m));
  const double log_determinant = log_determinant_ + e.log_determinant + 2.0 * log_diagonal(lower);
  AtScales out;
  out.without = quadratic(log_determinant, here, {}, e.removed, every_);
  for (std::size_t c = 0; c < change_first_.size(); ++c) {
    const Index first = change_first_[c], count = change_count_[c];
    if (out.change.emplace_back(); contrast != kAll && contrast != static_cast<int>(c)) continue;
    std::vector<int> asked = {0};
    for (const int s : asked_[c]) asked.push_back(1 + s);
    const MatrixXd coupling = linalg::lower_solve(lower, d.asDiagonal() * e.gram.block(0, first, m, count));
    const MatrixXd own = e.gram.block(first, first, count, count) - linalg::product(coupling, coupling, true);
    const MatrixXd here_asked = here(Eigen::all, asked), right = e.right.middleRows(first, count)(Eigen::all, asked);
    const MatrixXd own_right = right - linalg::product(coupling, here_asked, true);
    for (const double kappa : grid_.change) {
      MatrixXd small = kappa * kappa * own;
      small.diagonal().array() += 1.0;
      const MatrixXd small_lower = factor_of(small);
      const MatrixXd change = linalg::lower_solve(small_lower, kappa * own_right);
      out.change.back().push_back(
          quadratic(log_determinant + 2.0 * log_diagonal(small_lower), here, change, e.removed, asked_[c]));
    }
  }
  return out;
}

HypothesisEvidence summed(const std::vector<EvidenceTerm>& terms, const ScaleGrid& grid) {
  HypothesisEvidence out;
  out.frequency = VectorXd::Zero(grid.frequency.size());
  out.shape = VectorXd::Zero(grid.shape.size());
  if (terms.empty()) return out;
  out.best = *std::max_element(terms.begin(), terms.end(),
                               [](const EvidenceTerm& a, const EvidenceTerm& b) { return a.log_weight < b.log_weight; });
  double total = 0.0, log_kappa = 0.0;
  bool change = false;
  for (const EvidenceTerm& term : terms) {
    const double weight = std::exp(term.log_weight - out.best.log_weight);
    const ScalePoint& point = grid.points[static_cast<std::size_t>(term.point)];
    total += weight;
    out.frequency[point.frequency] += weight;
    out.shape[point.shape] += weight;
    if (term.kappa >= 0) log_kappa += weight * std::log(grid.change[term.kappa]);
    change = change || term.kappa >= 0;
  }
  out.log_evidence = out.best.log_weight + std::log(total);
  out.frequency /= total;
  out.shape /= total;
  if (change) out.kappa = std::exp(log_kappa / total);
  return out;
}

ScaleEstimate estimate(const VectorXd& points, const VectorXd& probability) {
  const Index n = points.size();
  const VectorXd at = points.array().log();
  ScaleEstimate out;
  out.level = std::exp(at.dot(probability) / probability.sum());
  Index most = 0;
  probability.maxCoeff(&most);
  out.at_end = most + 1 == n;
  const auto quantile = [&](double part) {
    double below = 0.0;
    for (Index i = 0; i < n; ++i) {
      const double p = probability[i] / probability.sum();
      // The outer cells reach as far out as in.
      const double left = i > 0 ? 0.5 * (at[i - 1] + at[i]) : 1.5 * at[0] - 0.5 * at[1];
      const double right = i + 1 < n ? 0.5 * (at[i] + at[i + 1]) : 1.5 * at[n - 1] - 0.5 * at[n - 2];
      if (below + p >= part && p > 0.0) return std::exp(left + (right - left) * (part - below) / p);
      below += p;
    }
    return points[n - 1];
  };
  out.low = quantile(0.05);
  out.high = quantile(0.95);
  return out;
}

}  // namespace twindeck::diagnosis
