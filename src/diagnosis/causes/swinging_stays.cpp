#include "diagnosis/causes/swinging_stays.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "core/lists.hpp"
#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "matching/pairing.hpp"

namespace twindeck::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double hit =
    0.7;  ///< [-] probability that a mode of the structure is explained; the refined bridge model pairs 9 of 11 measured ones
constexpr double least_chance =
    0.02;  ///< [-] least probability of an accident, and of no accident: bands and lists of modes are not known better
constexpr double least_within = 0.02, most_within = 0.10;  ///< [-] see frequency_scatter
constexpr double whole_mac = 3.0;         ///< [-] cost of MAC = 0 in units of `within`, as in the pairing of the diagnosis
constexpr double farthest = 4.0;          ///< [-] in units of `within`; larger distances of frequency cost no more
constexpr double explained_first = 10.0;  ///< [-] above all costs of a pair, so that most modes are explained

MatrixXd likeness(const std::vector<MeasuredShape>& measured, const VisibleModes& modes) {
  MatrixXd mac(std::ssize(measured), modes.frequency_Hz.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const MatrixXd seen = modes.shapes(measured[i].channels, Eigen::all);
    const double norm = measured[i].values.squaredNorm();
    for (Index j = 0; j < mac.cols(); ++j) {
      const double norms = norm * seen.col(j).squaredNorm();
      mac(static_cast<Index>(i), j) =
          norms > 0.0 ? std::norm(measured[i].values.dot(seen.col(j).cast<std::complex<double>>())) / norms : 0.0;
    }
  }
  return mac;
}

/// Part of the band (in ln f) where the model has a mode like a shape.
double chance(const Eigen::RowVectorXd& mac, const VisibleModes& modes, const ExplanationRule& rule, double low, double high) {
  double covered = 0.0, end = low;
  for (Index j = 0; j < mac.size(); ++j) {
    if (mac[j] < rule.least_mac || !(modes.frequency_Hz[j] > 0.0)) continue;
    const double f = std::log(modes.frequency_Hz[j]);
    const double from = std::max(f - rule.within, end), to = std::min(f + rule.within, high);
    if (to <= from) continue;
    covered += to - from;
    end = to;
  }
  return std::clamp(covered / (high - low), least_chance, 1.0 - least_chance);
}

constexpr double twins_within = 0.02;  ///< [-] of ln f: mirror images differ by the scatter of their forces

std::vector<const SwingingCable*> of(const std::vector<SwingingCable>& cables, const std::vector<int>& chosen) {
  std::vector<const SwingingCable*> out;
  for (const int i : chosen) out.push_back(&cables[static_cast<std::size_t>(i)]);
  return out;
}

/// Single stays, and all sets of stays with equal frequencies.
std::vector<std::vector<int>> groups(const std::vector<double>& own_Hz) {
  std::vector<std::vector<int>> out;
  for (std::size_t i = 0; i < own_Hz.size(); ++i) out.push_back({static_cast<int>(i)});
  for (std::size_t i = 0; i < own_Hz.size(); ++i) {
    std::vector<int> twins;
    for (std::size_t j = 0; j < own_Hz.size(); ++j)
      if (std::abs(std::log(own_Hz[j] / own_Hz[i])) <= twins_within) twins.push_back(static_cast<int>(j));
    if (twins.size() > 1 && !contains(out, twins)) out.push_back(twins);
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

ExplainedModes explain(const std::vector<MeasuredShape>& measured, const VisibleModes& modes, const ExplanationRule& rule) {
  ExplainedModes out;
  const std::size_t n = measured.size();
  out.mode.assign(n, -1);
  out.explained.assign(n, false);
  if (n == 0 || modes.frequency_Hz.size() == 0) return out;
  const MatrixXd mac = likeness(measured, modes);
  std::set<int> conditions;
  double low = std::log(measured[0].frequency_Hz), high = low;
  for (const MeasuredShape& m : measured) {
    conditions.insert(m.condition);
    low = std::min(low, std::log(m.frequency_Hz));
    high = std::max(high, std::log(m.frequency_Hz));
  }
  const auto distance = [&](std::size_t i, Index j) {
    return modes.frequency_Hz[j] > 0.0 ? std::abs(std::log(modes.frequency_Hz[j] / measured[i].frequency_Hz)) / rule.within
                                       : farthest;
  };
  const auto explains = [&](std::size_t i, Index j) {
    return mac(static_cast<Index>(i), j) >= rule.least_mac && distance(i, j) <= 1.0;
  };
  for (const int condition : conditions) {
    std::vector<std::size_t> here;
    for (std::size_t i = 0; i < n; ++i)
      if (measured[i].condition == condition) here.push_back(i);
    MatrixXd gain(std::ssize(here), mac.cols());
    for (std::size_t k = 0; k < here.size(); ++k)
      for (Index j = 0; j < mac.cols(); ++j)
        gain(static_cast<Index>(k), j) = (explains(here[k], j) ? explained_first : 0.0) -
                                         std::min(distance(here[k], j), farthest) -
                                         whole_mac * (1.0 - mac(static_cast<Index>(here[k]), j));
    const std::vector<int> chosen = matching::best_assignment(gain);
    for (std::size_t k = 0; k < here.size(); ++k) {
      out.mode[here[k]] = chosen[k];
      out.explained[here[k]] = chosen[k] >= 0 && explains(here[k], chosen[k]);
      out.count += out.explained[here[k]] ? 1 : 0;
    }
  }
  std::map<std::string, std::pair<double, int>> terms;
  // The band extends beyond the outermost modes by the tolerance of a frequency.
  low -= rule.within;
  high += rule.within;
  for (std::size_t i = 0; i < n; ++i) {
    const double c = chance(mac.row(static_cast<Index>(i)), modes, rule, low, high);
    auto& [sum, times] = terms[measured[i].name];
    sum += out.explained[i] ? std::log(hit / c) : std::log((1.0 - hit) / (1.0 - c));
    ++times;
  }
  for (const auto& [name, term] : terms) out.log_likelihood += term.first / term.second;
  return out;
}

double frequency_scatter(const std::vector<MeasuredShape>& measured, const VisibleModes& modes, double least_mac) {
  const ExplainedModes nearest = explain(measured, modes, {least_mac, most_within});
  std::vector<double> off;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (nearest.explained[i]) off.push_back(std::abs(std::log(modes.frequency_Hz[nearest.mode[i]] / measured[i].frequency_Hz)));
  if (off.empty()) return most_within;
  return std::clamp(2.0 * upper_median(off) / 0.6745, least_within, most_within);
}

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
    if (contains(kept, chosen[i])) {
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
