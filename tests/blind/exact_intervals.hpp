#pragma once

#include <cmath>
#include <functional>
#include <utility>

/// Exact 95 % intervals of what a run of trials counts.
namespace twindeck::blind {

/// P(K >= k) of n trials at p.
[[nodiscard]] inline double binomial_upper_tail(int k, int n, double p) {
  double sum = 0.0;
  for (int i = k; i <= n; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

/// P(K <= k) of a Poisson variable of this mean.
[[nodiscard]] inline double poisson_lower_tail(int k, double mean) {
  double sum = 0.0;
  for (int i = 0; i <= k; ++i) sum += std::exp(i * std::log(mean) - mean - std::lgamma(i + 1.0));
  return sum;
}

/// Where a function that rises with x reaches `level`, between low and high.
[[nodiscard]] inline double where_reached(const std::function<double(double)>& rising, double level, double low, double high) {
  for (int i = 0; i < 60; ++i) (rising(0.5 * (low + high)) < level ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

/// The exact 95 % interval of a proportion (Clopper and Pearson 1934): right for few trials too.
[[nodiscard]] inline std::pair<double, double> exact_interval(int k, int n) {
  const auto reached = [&](int from, double level) {
    return where_reached([&](double p) { return binomial_upper_tail(from, n, p); }, level, 1e-12, 1.0 - 1e-12);
  };
  return {k == 0 ? 0.0 : reached(k, 0.025), k == n ? 1.0 : reached(k + 1, 0.975)};
}

/// Probability of `k` hits or a worse count out of `n` at this rate.
[[nodiscard]] inline double worse_or_equal(int k, int n, double rate, bool at_least) {
  return at_least ? 1.0 - binomial_upper_tail(k + 1, n, rate) : binomial_upper_tail(k, n, rate);
}

/// The exact 95 % interval of a mean count (Garwood 1936). @param k  events counted in all @return of the mean of k
[[nodiscard]] inline std::pair<double, double> exact_count_interval(int k) {
  const double most = 10.0 * (k + 10.0);
  const auto at_least = [&](int from) {  // P(K >= from) rises with the mean
    return [=](double mean) { return 1.0 - poisson_lower_tail(from - 1, mean); };
  };
  return {k == 0 ? 0.0 : where_reached(at_least(k), 0.025, 1e-9, most), where_reached(at_least(k + 1), 0.975, 1e-9, most)};
}

/// The exact 95 % interval of the root mean square of n independent normal errors of mean 0. The chi-squared law with 2 m
/// degrees of freedom is the tail of a Poisson law; an odd n counts as one less.
[[nodiscard]] inline std::pair<double, double> exact_deviation_interval(double rms, int n) {
  if (n < 2) return {0.0, 1e300};
  const int half = n / 2;
  const auto quantile = [&](double level) {
    return 2.0 *
           where_reached([&](double x) { return 1.0 - poisson_lower_tail(half - 1, x); }, level, 1e-9, 10.0 * (half + 10.0));
  };
  return {rms * std::sqrt(2.0 * half / quantile(0.975)), rms * std::sqrt(2.0 * half / quantile(0.025))};
}

}  // namespace twindeck::blind
