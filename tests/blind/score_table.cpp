#include "blind/score_table.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twindeck::blind {

std::vector<ScoreLine> score_lines() {
  const auto null = [](const Score& s) { return s.kind == "null"; };
  const auto effect = [](const Score& s) { return s.kind == "effect"; };
  const auto found = [=](const Score& s) { return effect(s) && s.detected; };
  return {{"false alarms on nulls (a name or unknown)", null, [](const Score& s) { return s.detected; }, 0.02, false, 0.04},
          {"names given on nulls", null, [](const Score& s) { return !s.found.empty(); }, 0.02, false, 0.02},
          {"gain claimed on nulls", null, [](const Score& s) { return s.gain_claimed; }, 0.05, false, 0.01},
          {"detection, 6 sigma and above", [=](const Score& s) { return effect(s) && s.sigma >= 6.0; },
           [](const Score& s) { return s.detected; }, 0.97, true, 0.963},
          {"detection, 4 to 6 sigma", [=](const Score& s) { return effect(s) && s.sigma >= 4.0 && s.sigma < 6.0; },
           [](const Score& s) { return s.detected; }, 0.50, true, 0.545},
          {"family named, given detected", found, [](const Score& s) { return s.family_named; }, 0.97, true, 0.866},
          {"exact entry, given detected and alone in its set", [=](const Score& s) { return found(s) && s.set_size == 1; },
           [](const Score& s) { return s.exact; }, 0.93, true, 0.961},
          {"truth in the reported set, given detected", found, [](const Score& s) { return s.in_set; }, 0.97, true, 0.955},
          {"90 % interval covers the magnitude", [](const Score& s) { return s.sized; },
           [](const Score& s) { return s.covered; }, 0.85, true, 0.911},
          {"both of two causes named", [](const Score& s) { return s.kind == "two"; }, [](const Score& s) { return s.both; },
           0.75, true, 0.8},
          {"outside the catalogue: no passing wrong name", [](const Score& s) { return s.kind == "outside"; },
           [](const Score& s) { return s.unknown; }, 0.90, true, 0.867}};
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
