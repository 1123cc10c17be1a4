#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "blind/trial.hpp"

namespace twindeck::blind {

/// The exact 95 % interval of a proportion (Clopper and Pearson 1934): right for few trials too.
[[nodiscard]] std::pair<double, double> exact_interval(int k, int n);

/// A line of the score: of which cases, what counts as a hit, what is asked for.
struct ScoreLine {
  std::string what;
  std::function<bool(const Score&)> of, hit;
  double target;
  bool at_least;
};

/// What is asked of the tier of features; `eased` by so much for tiers that see less.
[[nodiscard]] std::vector<ScoreLine> score_lines(double eased);

/// Prints the lines with intervals. @return false when an interval lies wholly on the wrong side of a target
[[nodiscard]] bool print_scores(const std::vector<ScoreLine>& lines, const std::vector<Score>& scores);

}  // namespace twindeck::blind
