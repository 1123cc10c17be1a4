#pragma once

#include <functional>
#include <string>
#include <vector>

#include "blind/exact_intervals.hpp"
#include "blind/trial.hpp"

namespace twindeck::blind {

/// A line of the score: of which cases, what counts as a hit, what is asked for.
struct ScoreLine {
  std::string what;
  std::function<bool(const Score&)> of, hit;
  double target;
  bool at_least;
  double rate = -1.0;  ///< the method's own, from long runs; below 0 where none was measured
};

/// What is asked of the tier of features. Rates: seeds 2001 to 2200 on the present
/// bridge.toml.
[[nodiscard]] std::vector<ScoreLine> score_lines();

/// What a run is held against.
enum class Judge {
  targets,    ///< fails when an interval lies wholly on the wrong side of a target: for long runs
  own_rates,  ///< fails at a count that the method's own rate gives once in a thousand runs or less: for the few trials of a
              ///< test, which other processors' last digits turn too
};

/// Prints the lines with intervals. @return false when a line fails
[[nodiscard]] bool print_scores(const std::vector<ScoreLine>& lines, const std::vector<Score>& scores,
                                Judge judge = Judge::targets);

}  // namespace twindeck::blind
