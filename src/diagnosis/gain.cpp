#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd standardised_residuals(const Inference& inference, const Fit& fit) {
  const FeatureMap& map = inference.map();
  VectorXd e = map.values() - fit.all.g;
  std::set<std::pair<int, RowType>> trained;
  const auto& rows = map.features().rows;
  for (const int r : inference.training()) trained.insert({rows[static_cast<std::size_t>(r)].condition, rows[static_cast<std::size_t>(r)].type});
  std::map<std::pair<int, RowType>, std::vector<int>> untrained;
  for (const int r : inference.held_out()) {
    const Row& row = rows[static_cast<std::size_t>(r)];
    const bool level = row.type == RowType::rms || row.type == RowType::psd_floor;
    if (level && !trained.contains({row.condition, row.type})) untrained[{row.condition, row.type}].push_back(r);
  }
  for (const auto& [key, list] : untrained) {
    double mean = 0.0;
    for (const int r : list) mean += e[r] / static_cast<double>(list.size());
    for (const int r : list) e[r] -= mean;
  }
  return e.cwiseQuotient(map.covariance().diagonal().cwiseSqrt());
}

Gain held_out_gain(const Inference& inference, const Fit& before, const Fit& after, int bootstrap, std::uint64_t seed) {
  Gain gain;
  const auto& features = inference.map().features();
  gain.rows = static_cast<int>(inference.held_out().size());
  if (gain.rows == 0) {
    gain.held_out = "no row was held out";
    return gain;
  }
  const VectorXd e0 = standardised_residuals(inference, before), e1 = standardised_residuals(inference, after);
  struct Block { double before = 0.0, after = 0.0; int rows = 0; };
  std::map<std::string, Block> by_name;
  std::set<std::string> conditions;
  for (const int r : inference.held_out()) {
    const Row& row = features.rows[static_cast<std::size_t>(r)];
    const std::string& condition = features.conditions[static_cast<std::size_t>(row.condition)].name;
    // Entries of one shape share errors: they stay together.
    Block& block = by_name[condition + "/" + (row.mode.empty() ? name_of(row.type) : row.mode)];
    block.before += e0[r] * e0[r];
    block.after += e1[r] * e1[r];
    block.rows += 1;
    conditions.insert(condition + (row.mode.empty() ? "" : " mode " + row.mode));
  }
  for (const std::string& name : conditions) {
    if (gain.held_out.size() > 160) {
      gain.held_out += " …";
      break;
    }
    gain.held_out += (gain.held_out.empty() ? "" : "; ") + name;
  }
  std::vector<Block> blocks;
  Block sum;
  for (const auto& [name, block] : by_name) {
    blocks.push_back(block);
    sum.before += block.before;
    sum.after += block.after;
    sum.rows += block.rows;
  }
  const auto reduction = [](const Block& b) { return b.before > 0.0 ? 100.0 * (1.0 - std::sqrt(b.after / b.before)) : 0.0; };
  gain.before = std::sqrt(sum.before / sum.rows);
  gain.after = std::sqrt(sum.after / sum.rows);
  gain.reduction_pct = reduction(sum);
  if (blocks.size() < 3) {  // too few to say how much it varies
    gain.low_pct = std::min(0.0, gain.reduction_pct);
    gain.high_pct = std::max(0.0, gain.reduction_pct);
    return gain;
  }
  std::mt19937_64 random(seed);
  std::vector<double> drawn;
  for (int i = 0; i < bootstrap; ++i) {
    Block resample;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const Block& b = blocks[random() % blocks.size()];
      resample.before += b.before;
      resample.after += b.after;
    }
    drawn.push_back(reduction(resample));
  }
  std::sort(drawn.begin(), drawn.end());
  gain.low_pct = drawn[static_cast<std::size_t>(0.05 * bootstrap)];
  gain.high_pct = drawn[static_cast<std::size_t>(0.95 * bootstrap)];
  return gain;
}

std::vector<EffectParameter> effect_parameters(const Inference& inference, const Fit& fit, std::size_t which) {
  const Cause& cause = fit.causes[which];
  const Candidate& candidate = *cause.candidate;
  const Index k = cause.a.size();
  std::vector<EffectParameter> out;
  if (k == 0) return out;
  Index first = 0;
  for (std::size_t c = 0; c < which; ++c) first += fit.causes[c].a.size();
  // Sigma_tot of the fit holds the causes' own scatter; seen through it, their information is F = S'S (I - S'S)^-1 on prior scale.
  // Without it: Sigma_0 = Sigma_tot - D D', information D0'D0 by the matrix inversion lemma.
  Eigen::MatrixXd s = fit.cause_jacobian;
  VectorXd prior(s.cols());
  Index at = 0;
  for (const Cause& c : fit.causes)
    for (Index i = 0; i < c.a.size(); ++i, ++at) prior[at] = 2.0 * (c.candidate->high[i] - c.candidate->low[i]);
  const Eigen::MatrixXd d = s * prior.asDiagonal();
  const Eigen::MatrixXd gram = d.transpose() * d;
  Eigen::MatrixXd inside = Eigen::MatrixXd::Identity(gram.rows(), gram.cols()) - gram;
  // Posterior covariance of prior-scaled coordinates is I - D' Sigma_tot^-1 D.
  inside = prior.asDiagonal() * inside * prior.asDiagonal();
  for (Index i = 0; i < k; ++i) {
    const double low = candidate.low[i], high = candidate.high[i], centre = cause.a[i];
    const double deviation = std::sqrt(std::max(inside(first + i, first + i), 1e-18));
    const double reach = std::min(4.0 * deviation, 1.0 * (high - low));
    const double from = std::max(low, centre - reach), to = std::min(high, centre + reach);
    constexpr int points = 25;
    std::vector<double> at_a, log_likelihood;
    for (int p = 0; p < points; ++p) {
      const double value = from + (to - from) * p / (points - 1);
      std::vector<Cause> causes = fit.causes;
      // The other unknowns of this cause follow along the ridge.
      for (Index j = 0; j < k; ++j) {
        const double follow = j == i ? value : cause.a[j] + inside(first + j, first + i) / std::max(inside(first + i, first + i), 1e-300) * (value - centre);
        causes[which].a[j] = std::clamp(follow, candidate.low[j], candidate.high[j]);
      }
      causes[which].a[i] = value;
      const Prediction moved = inference.map().predict(fit.base, causes, false);
      at_a.push_back(value);
      if (!moved.valid) {
        log_likelihood.push_back(-1e300);
        continue;
      }
      // x follows too: what it can take up is in Sigma_tot, from which the cause's own part is removed (Woodbury).
      VectorXd change(static_cast<Index>(inference.training().size()));
      for (std::size_t r = 0; r < inference.training().size(); ++r)
        change[static_cast<Index>(r)] = moved.g[inference.training()[r]] - fit.all.g[inference.training()[r]];
      const VectorXd c = fit.total_factor.triangularView<Eigen::Lower>().solve(change);
      const Eigen::MatrixXd own = d.middleCols(first, k);
      const Eigen::MatrixXd capacity = Eigen::MatrixXd::Identity(k, k) - own.transpose() * own;
      const VectorXd projected = own.transpose() * c;
      const double distance = c.squaredNorm() + projected.dot(capacity.ldlt().solve(projected));
      // About the optimum the residual is orthogonal to what the cause can do.
      log_likelihood.push_back(-0.5 * distance);
    }
    const double top = *std::max_element(log_likelihood.begin(), log_likelihood.end());
    std::vector<double> cumulative(points, 0.0);
    for (int p = 1; p < points; ++p) {
      const auto q = static_cast<std::size_t>(p);
      cumulative[q] = cumulative[q - 1] + 0.5 * (std::exp(log_likelihood[q] - top) + std::exp(log_likelihood[q - 1] - top)) * (at_a[q] - at_a[q - 1]);
    }
    const auto quantile = [&](double level) {
      const double target = level * cumulative.back();
      for (std::size_t q = 1; q < at_a.size(); ++q)
        if (cumulative[q] >= target)
          return at_a[q - 1] + (at_a[q] - at_a[q - 1]) * (target - cumulative[q - 1]) / std::max(cumulative[q] - cumulative[q - 1], 1e-300);
      return at_a.back();
    };
    const UnknownSpec& spec = candidate.hypothesis->unknowns[static_cast<std::size_t>(i)];
    EffectParameter parameter{spec.name, spec.unit, candidate.physical(cause.a, i), 0.0, 0.0, false, false};
    VectorXd end = cause.a;
    // An end that the data do not see is the prior's: the other one is a limit.
    const double lower = quantile(0.05), upper = quantile(0.95);
    parameter.at_low_bound = lower < low + 0.06 * (high - low);
    parameter.at_high_bound = upper > high - 0.06 * (high - low);
    end[i] = parameter.at_low_bound ? low : lower;
    parameter.low = candidate.physical(end, i);
    end[i] = parameter.at_high_bound ? high : upper;
    parameter.high = candidate.physical(end, i);
    out.push_back(parameter);
  }
  return out;
}

}  // namespace twindeck::diagnosis
