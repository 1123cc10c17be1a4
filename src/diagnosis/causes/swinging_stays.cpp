#include "diagnosis/causes/swinging_stays.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/parallel.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double twins_within = 0.02;  ///< [-] of ln f: mirror images on a bridge differ by what their forces scatter

std::vector<const SwingingCable*> of(const std::vector<SwingingCable>& cables, const std::vector<int>& chosen) {
  std::vector<const SwingingCable*> out;
  for (const int i : chosen) out.push_back(&cables[static_cast<std::size_t>(i)]);
  return out;
}

/// Every stay, and every set of stays of one frequency.
std::vector<std::vector<int>> groups(const std::vector<double>& own_Hz) {
  std::vector<std::vector<int>> out;
  for (std::size_t i = 0; i < own_Hz.size(); ++i) out.push_back({static_cast<int>(i)});
  for (std::size_t i = 0; i < own_Hz.size(); ++i) {
    std::vector<int> twins;
    for (std::size_t j = 0; j < own_Hz.size(); ++j)
      if (std::abs(std::log(own_Hz[j] / own_Hz[i])) <= twins_within) twins.push_back(static_cast<int>(j));
    if (twins.size() > 1 && std::find(out.begin(), out.end(), twins) == out.end()) out.push_back(twins);
  }
  return out;
}

std::vector<int> joined(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  a.erase(std::unique(a.begin(), a.end()), a.end());
  return a;
}

}  // namespace

SwingingCable swinging_cable(const MatrixXd& stiffness, const MatrixXd& mass, const MatrixXd& end_motion, double highest_Hz) {
  const Index n = stiffness.rows() - 6;
  const MatrixXd inner = stiffness.bottomRightCorner(n, n);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(inner, MatrixXd(mass.bottomRightCorner(n, n)));
  const double limit = std::pow(2.0 * std::numbers::pi * highest_Hz, 2);
  const Index kept = (solver.eigenvalues().array() <= limit).count();
  // Motion [ends; inner] = T [ends; cable's modes]: the inner nodes follow the ends statically.
  MatrixXd follow = MatrixXd::Zero(n + 6, 6), own = MatrixXd::Zero(n + 6, kept);
  follow.topRows(6).setIdentity();
  follow.bottomRows(n) = -inner.llt().solve(MatrixXd(stiffness.bottomLeftCorner(n, 6)));
  own.bottomRows(n) = solver.eigenvectors().leftCols(kept);
  SwingingCable out;
  out.ends_mass = end_motion.transpose() * (follow.transpose() * mass * follow) * end_motion;
  out.coupling = end_motion.transpose() * (follow.transpose() * mass * own);
  out.omega2 = solver.eigenvalues().head(kept);
  return out;
}

VisibleModes modes_with(const BarModes& bars, const std::vector<const SwingingCable*>& cables) {
  const Index m = bars.omega2.size();
  Index size = m;
  for (const SwingingCable* cable : cables) size += cable->omega2.size();
  MatrixXd k = MatrixXd::Zero(size, size), mass = MatrixXd::Identity(size, size);
  k.diagonal().head(m) = bars.omega2;
  Index at = m;
  for (const SwingingCable* cable : cables) {
    const Index h = cable->omega2.size();
    mass.topLeftCorner(m, m) += cable->ends_mass;
    mass.block(0, at, m, h) = cable->coupling;
    mass.block(at, 0, h, m) = cable->coupling.transpose();
    k.diagonal().segment(at, h) = cable->omega2;
    at += h;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, mass);
  return {solver.eigenvalues().cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi),
          bars.channels * solver.eigenvectors().topRows(m)};
}

StayChoice choose_swinging(const BarModes& bars, const std::vector<SwingingCable>& cables, const std::vector<double>& own_Hz,
                           const std::vector<int>& known, const std::vector<MeasuredShape>& measured,
                           const ExplanationRule& rule, double least_gain) {
  const auto likelihood = [&](const std::vector<int>& swinging) {
    return explain(measured, modes_with(bars, of(cables, swinging)), rule).log_likelihood;
  };
  StayChoice out;
  out.before = explain(measured, modes_with(bars, {}), rule);
  const std::vector<std::vector<int>> choices = groups(own_Hz);
  const double price = std::log(static_cast<double>(std::max<std::size_t>(choices.size(), 2)));
  double best = out.before.log_likelihood, paid = 0.0;
  std::vector<int>& chosen = out.swinging;
  if (const double value = likelihood(known); value > best) {
    best = value;
    chosen = known;
  }
  const std::vector<int> kept = chosen;
  while (true) {  // forwards
    std::vector<double> value(choices.size());
    parallel_for(choices.size(), [&](std::size_t i) {
      const std::vector<int> tried = joined(chosen, choices[i]);
      value[i] = tried.size() > chosen.size() ? likelihood(tried) : best;
    });
    const auto at = std::max_element(value.begin(), value.end());
    if (!(*at > best + price + least_gain)) break;
    best = *at;
    paid += price;
    chosen = joined(chosen, choices[static_cast<std::size_t>(at - value.begin())]);
  }
  for (std::size_t i = 0; i < chosen.size();) {  // backwards
    if (std::find(kept.begin(), kept.end(), chosen[i]) != kept.end()) {
      ++i;
      continue;
    }
    std::vector<int> without = chosen;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
    const double value = likelihood(without);
    if (value >= best) {
      best = value;
      chosen = without;
    } else {
      ++i;
    }
  }
  std::vector<int> all(cables.size());
  std::iota(all.begin(), all.end(), 0);
  if (const double value = likelihood(all); value > best - paid + least_gain) {
    best = value;
    paid = 0.0;
    chosen = all;
  }
  out.log_odds = best - paid - out.before.log_likelihood;
  out.modes = modes_with(bars, of(cables, chosen));
  out.after = explain(measured, out.modes, rule);
  return out;
}

}  // namespace twindeck::diagnosis
