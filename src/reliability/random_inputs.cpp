#include "reliability/random_inputs.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/extreme_value.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/distributions.hpp"
#include "core/error.hpp"

namespace twindeck::reliability {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Two parameters of a law from its mean and deviation: location and scale, scale and shape, or the two ends.
struct Parameters {
  double first = 0.0, second = 1.0;
};

double weibull_shape(double variation) {
  // (sigma/mean)² = Gamma(1+2/k)/Gamma(1+1/k)² - 1 falls with k.
  const auto excess = [&](double k) {
    return std::lgamma(1.0 + 2.0 / k) - 2.0 * std::lgamma(1.0 + 1.0 / k) - std::log1p(variation * variation);
  };
  std::uintmax_t steps = 200;
  const auto bracket =
      boost::math::tools::toms748_solve(excess, 0.05, 1e4, boost::math::tools::eps_tolerance<double>(48), steps);
  return 0.5 * (bracket.first + bracket.second);
}

Parameters parameters(const RandomInput& input) {
  const double m = input.mean, s = input.deviation;
  switch (input.kind) {
    case LawKind::normal:
      return {m, s};
    case LawKind::lognormal: {
      const double variance = std::log1p(s * s / (m * m));
      return {std::log(m) - 0.5 * variance, std::sqrt(variance)};
    }
    case LawKind::uniform:
      return {m - std::numbers::sqrt3 * s, m + std::numbers::sqrt3 * s};
    case LawKind::gumbel: {
      const double scale = s * std::sqrt(6.0) / std::numbers::pi;
      return {m - std::numbers::egamma * scale, scale};
    }
    case LawKind::weibull: {
      const double shape = weibull_shape(s / m);
      return {m / std::tgamma(1.0 + 1.0 / shape), shape};
    }
  }
  return {};
}

/// P(X <= x), or P(X > x) where `upper`.
double probability(const RandomInput& input, double x, bool upper) {
  const Parameters p = parameters(input);
  const auto of = [&](const auto& law) { return upper ? cdf(complement(law, x)) : cdf(law, x); };
  switch (input.kind) {
    case LawKind::normal:
      return normal_tail((upper ? 1.0 : -1.0) * (x - p.first) / p.second);
    case LawKind::lognormal:
      return x <= 0.0 ? (upper ? 1.0 : 0.0) : normal_tail((upper ? 1.0 : -1.0) * (std::log(x) - p.first) / p.second);
    case LawKind::uniform: {
      const double share = std::clamp((x - p.first) / (p.second - p.first), 0.0, 1.0);
      return upper ? 1.0 - share : share;
    }
    case LawKind::gumbel:
      return of(boost::math::extreme_value(p.first, p.second));
    case LawKind::weibull:
      return x <= 0.0 ? (upper ? 1.0 : 0.0) : of(boost::math::weibull(p.second, p.first));
  }
  return 0.0;
}

/// x with P(X <= x) = share, or P(X > x) = share where `upper`; share in ]0, 1[.
double quantile_of(const RandomInput& input, double share, bool upper) {
  const Parameters p = parameters(input);
  const auto of = [&](const auto& law) { return upper ? quantile(complement(law, share)) : quantile(law, share); };
  const auto normal = [&] { return (upper ? -1.0 : 1.0) * normal_quantile(share); };
  switch (input.kind) {
    case LawKind::normal:
      return p.first + p.second * normal();
    case LawKind::lognormal:
      return std::exp(p.first + p.second * normal());
    case LawKind::uniform:
      return p.first + (p.second - p.first) * (upper ? 1.0 - share : share);
    case LawKind::gumbel:
      return of(boost::math::extreme_value(p.first, p.second));
    case LawKind::weibull:
      return of(boost::math::weibull(p.second, p.first));
  }
  return 0.0;
}

/// Value of an input at z of the standard normal law. Probabilities are counted from the nearer end, so that far tails keep
/// their digits.
double value_at(const RandomInput& input, double z) {
  if (input.kind == LawKind::normal && !input.low && !input.high) return input.mean + input.deviation * z;
  const bool upper = z > 0.0;
  const double beyond_low = input.low ? probability(input, *input.low, upper) : (upper ? 1.0 : 0.0);
  const double beyond_high = input.high ? probability(input, *input.high, upper) : (upper ? 0.0 : 1.0);
  // Share of the law between one end and x. For z > 0 it is counted from the upper end, otherwise from the lower.
  const double end = upper ? beyond_high : beyond_low, width = std::abs(beyond_high - beyond_low);
  const double share = std::clamp(end + width * normal_tail(std::abs(z)), 1e-300, 1.0 - 1e-16);
  const double x = quantile_of(input, share, upper);
  return std::clamp(x, input.low.value_or(x), input.high.value_or(x));
}

void check(const RandomInput& input) {
  const auto refuse = [&](const std::string& what, const std::string& mend) {
    throw InputError({"", 0, input.name}, what, mend);
  };
  if (!(input.deviation >= 0.0) || !std::isfinite(input.deviation))
    refuse(fmt::format("has deviation {}, expected zero or more", input.deviation),
           "give the standard deviation as a positive number");
  if (!std::isfinite(input.mean)) refuse(fmt::format("has mean {}, expected a number", input.mean), "give the mean");
  if (input.low && input.high && !(*input.low < *input.high))
    refuse(fmt::format("has low = {} and high = {}, expected low < high", *input.low, *input.high), "exchange the two");
  if (input.deviation == 0.0) return;
  if ((input.kind == LawKind::lognormal || input.kind == LawKind::weibull) && !(input.mean > 0.0))
    refuse(fmt::format("has mean {}, and a {} law has values above zero alone", input.mean, law_name(input.kind)),
           "give a positive mean, or law normal");
  const double below = input.low ? probability(input, *input.low, false) : 0.0;
  const double above = input.high ? probability(input, *input.high, true) : 0.0;
  if (!(below + above < 1.0 - 1e-12))
    refuse(fmt::format("has no probability between low and high: mean {} and deviation {} put it outside", input.mean,
                       input.deviation),
           "widen the ends, or correct mean and deviation");
}

}  // namespace

std::string law_name(LawKind kind) { return law_names.at(static_cast<std::size_t>(kind)); }

RandomVector::RandomVector(std::vector<RandomInput> inputs, const MatrixXd& correlation) : inputs_(std::move(inputs)) {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    check(inputs_[i]);
    if (inputs_[i].deviation > 0.0) random_.push_back(i);
  }
  const Index m = dimension();
  factor_ = MatrixXd::Identity(m, m);
  if (correlation.size() == 0) return;
  TWINDECK_ASSERT(correlation.rows() == std::ssize(inputs_) && correlation.cols() == correlation.rows());
  MatrixXd of_random(m, m);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j)
      of_random(i, j) = correlation(static_cast<Index>(random_[static_cast<std::size_t>(i)]),
                                    static_cast<Index>(random_[static_cast<std::size_t>(j)]));
  const Eigen::LLT<MatrixXd> factor(of_random);
  if (factor.info() != Eigen::Success || !of_random.diagonal().isOnes(1e-9))
    throw InputError({"", 0, "correlation"}, "is no correlation matrix: it is not positive definite with ones on its diagonal",
                     "check the signs and sizes of the correlations");
  factor_ = factor.matrixL();
}

VectorXd RandomVector::values(const Eigen::Ref<const VectorXd>& u) const {
  TWINDECK_ASSERT(u.size() == dimension());
  const VectorXd z = factor_ * u;
  VectorXd x(std::ssize(inputs_));
  for (std::size_t i = 0; i < inputs_.size(); ++i) x[static_cast<Index>(i)] = inputs_[i].mean;
  for (Index k = 0; k < z.size(); ++k) {
    const std::size_t i = random_[static_cast<std::size_t>(k)];
    x[static_cast<Index>(i)] = value_at(inputs_[i], z[k]);
  }
  return x;
}

}  // namespace twindeck::reliability
