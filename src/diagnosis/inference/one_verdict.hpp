#pragma once

#include <string>
#include <vector>

namespace twindeck::diagnosis {

enum class Verdict { none, named, ambiguous, unknown };
/// The verdict as a word, as in diagnosis.json.
[[nodiscard]] std::string name_of(Verdict verdict);

/// Answer beside "nothing": an entry of the catalogue, or "something else changed".
struct PossibleAnswer {
  double log_weight = 0.0;  ///< ln (evidence × prior)
  bool something_else = false;
};

/// [-] Probability of the set of answers, and of the answer that there is a cause.
constexpr double kSetProbability = 0.95;

struct Judgement {
  Verdict verdict = Verdict::none;
  double log_odds = -1e300;         ///< ln of all answers' weight over that of nothing
  double nothing = 1.0;             ///< probability of nothing
  std::vector<double> probability;  ///< of each answer
  std::vector<int> set;             ///< the smallest set of answers with 95 % of what is not nothing, the most probable first
  bool something_else_in_set = false;
};

/// The verdict's table. `none` if nothing keeps a probability of 5 %. Otherwise the set decides: led by "something else" it is
/// `unknown`, one entry is `named`, and several are `ambiguous`.
[[nodiscard]] Judgement judge(double log_weight_of_nothing, const std::vector<PossibleAnswer>& answers);

}  // namespace twindeck::diagnosis
