#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<EffectParameter> effect_parameters(const Inference& inference, const Fit& fit, std::size_t which) {
  const Cause& cause = fit.causes[which];
  const Candidate& candidate = *cause.candidate;
  const Index k = cause.a.size();
  std::vector<EffectParameter> out;
  if (k == 0) return out;
  Index first = 0;
  for (std::size_t c = 0; c < which; ++c) first += fit.causes[c].a.size();
  // Sigma_tot of the fit holds the causes' own scatter; seen through it, their information is F = S'S (I - S'S)^-1 on prior
  // scale. Without it: Sigma_0 = Sigma_tot - D D', information D0'D0 by the matrix inversion lemma.
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
  // Misfit that the causes leave widens their intervals as it widens the odds (Birge 1932): the errors are larger than stated.
  const double misfit = std::max(1.0, fit.chi_squared / inference.dof());
  for (Index i = 0; i < k; ++i) {
    const double low = candidate.low[i], high = candidate.high[i], centre = cause.a[i];
    const double deviation = std::sqrt(std::max(inside(first + i, first + i), 1e-18));
    const double reach = std::min(4.0 * std::sqrt(misfit) * deviation, 1.0 * (high - low));
    const double from = std::max(low, centre - reach), to = std::min(high, centre + reach);
    constexpr int points = 25;
    std::vector<double> at_a(points), log_likelihood(points, -1e300);
    parallel_for(points, [&](int p) {
      const double value = from + (to - from) * p / (points - 1);
      std::vector<Cause> causes = fit.causes;
      // The other unknowns of this cause follow along the ridge.
      for (Index j = 0; j < k; ++j) {
        const double follow = j == i ? value
                                     : cause.a[j] + inside(first + j, first + i) /
                                                        std::max(inside(first + i, first + i), 1e-300) * (value - centre);
        causes[which].a[j] = std::clamp(follow, candidate.low[j], candidate.high[j]);
      }
      causes[which].a[i] = value;
      const Prediction moved = inference.map().predict(fit.base, causes, false);
      at_a[static_cast<std::size_t>(p)] = value;
      if (!moved.valid) return;
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
      log_likelihood[static_cast<std::size_t>(p)] = -0.5 * distance / misfit;
    });
    const double top = *std::max_element(log_likelihood.begin(), log_likelihood.end());
    std::vector<double> cumulative(points, 0.0);
    for (int p = 1; p < points; ++p) {
      const auto q = static_cast<std::size_t>(p);
      cumulative[q] = cumulative[q - 1] + 0.5 * (std::exp(log_likelihood[q] - top) + std::exp(log_likelihood[q - 1] - top)) *
                                              (at_a[q] - at_a[q - 1]);
    }
    const auto quantile = [&](double level) {
      const double target = level * cumulative.back();
      for (std::size_t q = 1; q < at_a.size(); ++q)
        if (cumulative[q] >= target)
          return at_a[q - 1] +
                 (at_a[q] - at_a[q - 1]) * (target - cumulative[q - 1]) / std::max(cumulative[q] - cumulative[q - 1], 1e-300);
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
