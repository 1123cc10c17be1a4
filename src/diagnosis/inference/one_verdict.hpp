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

/// [-] Probability of the set of answers. The verdict is `none` unless "nothing" has less than the rest of 1.
constexpr double kSetProbability = 0.95;

struct Judgement {
  Verdict verdict = Verdict::none;
  double log_odds = -1e300;         ///< ln of the weight of all answers over that of "nothing"
  double nothing = 1.0;             ///< probability of nothing
  std::vector<double> probability;  ///< of each answer
  std::vector<int> set;  ///< smallest set with 95 % of the probability of all answers, the most probable answer first
  bool something_else_in_set = false;
};

/// The verdict is `none` if "nothing" keeps a probability of 5 % or more. Otherwise the set decides: if "something else" leads,
/// the verdict is `unknown`; if the set has one entry, `named`; if it has several, `ambiguous`.
[[nodiscard]] Judgement judge(double log_weight_of_nothing, const std::vector<PossibleAnswer>& answers);

}  // namespace twindeck::diagnosis
