// Whitening and the base fit. Oracles: the laws of chi-square statistics for Gaussian data (Basseville and Nikiforov 2005),
// with the truth's modes computed by dense matrices apart from the diagnosis; and a fit's independence of where it starts.
#include "diagnosis/inference.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"
#include "core/distributions.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Fit;
using Eigen::Index;
using Eigen::VectorXd;

/// p-value of Kolmogorov's test of `sample` against the distribution function `cdf` (Stephens 1970).
template <typename Cdf>
double kolmogorov(std::vector<double> sample, Cdf cdf) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double d = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double f = cdf(sample[i]);
    d = std::max({d, f - static_cast<double>(i) / n, (static_cast<double>(i) + 1.0) / n - f});
  }
  const double z = d * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));
  double p = 0.0;
  for (int k = 1; k < 60; ++k) p += (k % 2 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * z * z);
  return std::clamp(p, 0.0, 1.0);
}

TEST(Inference, NullStatisticsFollowTheirLaws) {
  // Springs known and everything else Gaussian, so that the laws hold exactly up to the model's slight curvature. Tolerance: p
  // > 0.01.
  ChainOptions options;
  options.masses = 10;
  options.parameters = false;
  const Chain chain(options);
  std::mt19937_64 random(2026);
  std::vector<double> omnibus, direct, min_max, shifted;
  for (int i = 0; i < 200; ++i) {
    const auto features = chain.measure(chain.scattered(random), &random);
    const Examined e = examine(chain, features, catalogue({"stiffness", "mass", "gain"}));
    const Fit fit = e.inference->fit({}, {});
    omnibus.push_back(fit.chi_squared);
    const auto signature = [&](const std::string& id, double physical) {
      const auto& candidate = e.entry(id);
      VectorXd a(1);
      a[0] = candidate.log[0] ? std::log(physical) : physical;
      return e.inference->signature(fit, candidate, a);
    };
    const VectorXd s = signature("stiffness@group:g3", 0.95), other = signature("mass@node:4", 60.0);
    direct.push_back(std::pow(s.dot(fit.whitened), 2) / s.squaredNorm());
    // Min-max: what is left of s when the best of the rival is taken out of it.
    const VectorXd rest = s - other * (other.dot(s) / other.squaredNorm());
    min_max.push_back(std::pow(rest.dot(fit.whitened), 2) / rest.squaredNorm());
    // With the effect in the rows the direct statistic has non-centrality s's.
    shifted.push_back((s.dot(fit.whitened) + s.squaredNorm()) / s.norm() - s.norm());
  }
  const auto one = [](double x) { return 1.0 - chi_squared_tail(x, 1.0); };
  // Rows that the base is fitted to, less a free scale for each shape among them (mode 8 is held out).
  const double dof = 7.0 * 11.0 - 7.0;
  EXPECT_GT(kolmogorov(omnibus, [&](double x) { return 1.0 - chi_squared_tail(x, dof); }), 0.01);
  EXPECT_GT(kolmogorov(direct, one), 0.01);
  EXPECT_GT(kolmogorov(min_max, one), 0.01);
  EXPECT_GT(kolmogorov(shifted, [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }), 0.01);
}

TEST(Inference, AnEffectShiftsTheDirectStatisticByItsSignature) {
  // With an effect that the truth carries, s'w/|s| is normal about |s|: the non-central law. 60 cases, so its mean has
  // deviation 0.13.
  ChainOptions options;
  options.masses = 10;
  options.parameters = false;
  const Chain chain(options);
  std::mt19937_64 random(7);
  double mean = 0.0, square = 0.0;
  constexpr int cases = 60;
  for (int i = 0; i < cases; ++i) {
    ChainTruth truth = chain.scattered(random);
    truth.spring[3] = 0.94;
    const Examined e = examine(chain, chain.measure(truth, &random), catalogue({"stiffness"}));
    const Fit fit = e.inference->fit({}, {});
    const VectorXd s = e.inference->signature(fit, e.entry("stiffness@group:g3"), VectorXd::Constant(1, std::log(0.94)));
    const double z = (s.dot(fit.whitened) - s.squaredNorm()) / s.norm();
    mean += z / cases;
    square += z * z / cases;
    ASSERT_GT(s.norm(), 2.0);  // an effect that the rows do see
  }
  EXPECT_NEAR(mean, 0.0, 0.45);    // 3.5 deviations
  EXPECT_NEAR(square, 1.0, 0.65);  // 3.5 deviations of chi² with 60 degrees of freedom, and the curvature of so large a change
}

TEST(Inference, FitDoesNotDependOnItsStart) {
  // 20 null cases, three random starts each: costs agree within one unit.
  const Chain chain;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const Examined e = examine(chain, chain.measure(chain.scattered(random), &random), catalogue({"gain"}));
    double low = 1e300, high = -1e300;
    for (int start = 0; start < 3; ++start) {
      VectorXd x(static_cast<Index>(e.map->nuisances().size()));
      for (Index j = 0; j < x.size(); ++j) {
        const auto& v = e.map->nuisances()[static_cast<std::size_t>(j)];
        x[j] = std::clamp(normal(random), v.lower, v.upper);
      }
      const Fit fit = e.inference->fit({}, x);
      low = std::min(low, fit.map.chi_squared);
      high = std::max(high, fit.map.chi_squared);
    }
    EXPECT_LT(high - low, 1.0) << "case " << i;
  }
}

TEST(Inference, RefusesRowsThatLeaveNothingToFit) {
  const Chain chain({.masses = 6, .modes = 4});
  auto features = chain.measure(chain.as_modelled());
  for (auto& row : features.rows) row.held_out = true;
  EXPECT_THROW(examine(chain, features, catalogue({"gain"})), InputError);
}

TEST(Inference, RefusesACovarianceThatIsNone) {
  const Chain chain({.masses = 6, .modes = 4});
  auto features = chain.measure(chain.as_modelled());
  const auto n = static_cast<Index>(features.rows.size());
  features.covariance = 1e-4 * Eigen::MatrixXd::Identity(n, n);
  features.covariance(2, 3) = features.covariance(3, 2) = 1.0;
  EXPECT_THROW(examine(chain, features, catalogue({"gain"})), InputError);
}

}  // namespace
}  // namespace twindeck::tests
