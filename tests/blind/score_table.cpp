#include "blind/score_table.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twindeck::blind {

namespace {

/// P(K >= k) of n trials at p.
double upper_tail(int k, int n, double p) {
  double sum = 0.0;
  for (int i = k; i <= n; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

}  // namespace

std::pair<double, double> exact_interval(int k, int n) {
  const auto solve = [&](int from, double level) {  // p at which P(K >= from) = level
    double low = 1e-12, high = 1.0 - 1e-12;
    for (int i = 0; i < 60; ++i) (upper_tail(from, n, 0.5 * (low + high)) < level ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  };
  return {k == 0 ? 0.0 : solve(k, 0.025), k == n ? 1.0 : solve(k + 1, 0.975)};
}

std::vector<ScoreLine> score_lines(double eased) {
  const auto null = [](const Score& s) { return s.kind == "null"; };
  const auto effect = [](const Score& s) { return s.kind == "effect"; };
  const auto found = [=](const Score& s) { return effect(s) && s.detected; };
  std::vector<ScoreLine> lines = {
      {"false alarms on nulls (a name or unknown)", null, [](const Score& s) { return s.detected; }, 0.02, false, 0.01},
      {"names given on nulls", null, [](const Score& s) { return !s.found.empty(); }, 0.02, false, 0.01},
      {"gain claimed on nulls", null, [](const Score& s) { return s.gain_claimed; }, 0.05, false, 0.01},
      {"detection, 6 sigma and above", [=](const Score& s) { return effect(s) && s.sigma >= 6.0; },
       [](const Score& s) { return s.detected; }, 0.97, true, 0.977},
      {"detection, 4 to 6 sigma", [=](const Score& s) { return effect(s) && s.sigma >= 4.0 && s.sigma < 6.0; },
       [](const Score& s) { return s.detected; }, 0.50, true, 0.475},
      {"family named, given detected", found, [](const Score& s) { return s.family_named; }, 0.97, true, 0.931},
      {"exact entry, given detected and alone in its set", [=](const Score& s) { return found(s) && s.set_size == 1; },
       [](const Score& s) { return s.exact; }, 0.93, true, 0.983},
      {"truth in the reported set, given detected", found, [](const Score& s) { return s.in_set; }, 0.97, true, 0.981},
      {"90 % interval covers the magnitude", [](const Score& s) { return s.sized; }, [](const Score& s) { return s.covered; },
       0.85, true, 0.89},
      {"both of two causes named", [](const Score& s) { return s.kind == "two"; }, [](const Score& s) { return s.both; }, 0.75,
       true, 0.8},
      {"outside the catalogue: no passing wrong name", [](const Score& s) { return s.kind == "outside"; },
       [](const Score& s) { return s.unknown; }, 0.90, true, 0.855}};
  for (ScoreLine& line : lines) line.target += line.at_least ? -eased : eased;
  return lines;
}

double worse_or_equal(int k, int n, double rate, bool at_least) {
  return at_least ? 1.0 - upper_tail(k + 1, n, rate) : upper_tail(k, n, rate);
}

bool print_scores(const std::vector<ScoreLine>& lines, const std::vector<Score>& scores, Judge judge) {
  constexpr double kOnceInAThousand = 1e-3;  // of all lines together
  bool held = true;
  for (const ScoreLine& line : lines) {
    int n = 0, k = 0;
    for (const Score& s : scores)
      if (line.of(s)) {
        ++n;
        k += line.hit(s) ? 1 : 0;
      }
    const auto [low, high] = exact_interval(k, n);
    const bool wrong =
        n > 0 && (judge == Judge::targets ? (line.at_least ? high < line.target : low > line.target)
                                          : line.rate >= 0.0 && worse_or_equal(k, n, line.rate, line.at_least) <
                                                                    kOnceInAThousand / static_cast<double>(lines.size()));
    held = held && !wrong;
    fmt::print("  {:<58} {:>4}/{:<4} {:>5.1f} %  [{:>5.1f}, {:>5.1f}]  target {} {:>3.0f} %{}  {}\n", line.what, k, n,
               n ? 100.0 * k / n : 0.0, 100.0 * low, 100.0 * high, line.at_least ? ">=" : "<=", 100.0 * line.target,
               judge == Judge::own_rates ? fmt::format(", own rate {:.1f} %", 100.0 * line.rate) : "",
               n == 0  ? "no case"
               : wrong ? "MISSED"
                       : "held");
  }
  return held;
}

}  // namespace twindeck::blind
