#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "blind/trial.hpp"

namespace twindeck::blind {

/// Wilson's 95 % interval of a proportion.
[[nodiscard]] inline std::pair<double, double> proportion_interval(int k, int n) {
  if (n == 0) return {0.0, 1.0};
  const double z = 1.959964, p = static_cast<double>(k) / n, d = 1.0 + z * z / n;
  const double centre = (p + z * z / (2.0 * n)) / d, half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)) / d;
  return {centre - half, centre + half};
}

/// A line of the score: of which cases, what counts as a hit, what is asked for.
struct ScoreLine {
  std::string what;
  std::function<bool(const Score&)> of, hit;
  double target;
  bool at_least;
};

/// Prints the lines with intervals. @return false when an interval lies wholly on the wrong side of its target
[[nodiscard]] bool print_scores(const std::vector<ScoreLine>& lines, const std::vector<Score>& scores);

}  // namespace twindeck::blind
