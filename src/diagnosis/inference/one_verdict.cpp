#include "diagnosis/inference/one_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace twindeck::diagnosis {

std::string name_of(Verdict verdict) {
  static constexpr const char* in_order[] = {"none", "named", "ambiguous", "unknown"};
  return in_order[static_cast<std::size_t>(verdict)];
}

Judgement judge(double log_weight_of_nothing, const std::vector<PossibleAnswer>& answers) {
  Judgement out;
  if (answers.empty()) return out;
  double top = log_weight_of_nothing;
  for (const PossibleAnswer& answer : answers) top = std::max(top, answer.log_weight);
  const double nothing = std::exp(log_weight_of_nothing - top);
  double rest = 0.0, most = answers.front().log_weight, scaled = 0.0;
  for (const PossibleAnswer& answer : answers) {
    rest += std::exp(answer.log_weight - top);
    most = std::max(most, answer.log_weight);
  }
  for (const PossibleAnswer& answer : answers) scaled += std::exp(answer.log_weight - most);
  out.log_odds = most + std::log(scaled) - log_weight_of_nothing;
  out.nothing = nothing / (nothing + rest);
  for (const PossibleAnswer& answer : answers) out.probability.push_back(std::exp(answer.log_weight - top) / (nothing + rest));
  std::vector<int> order(answers.size());
  std::iota(order.begin(), order.end(), 0);
  const auto weight = [&](int i) { return answers[static_cast<std::size_t>(i)].log_weight; };
  std::ranges::stable_sort(order, [&](int a, int b) { return weight(a) > weight(b); });
  double sum = 0.0;
  for (const int i : order) {
    if (sum >= kSetProbability * scaled) break;
    out.set.push_back(i);
    sum += std::exp(weight(i) - most);
  }
  const auto is_else = [&](int i) { return answers[static_cast<std::size_t>(i)].something_else; };
  out.something_else_in_set = std::ranges::any_of(out.set, is_else);
  if (out.nothing >= 1.0 - kSetProbability) return out;
  out.verdict = is_else(out.set.front()) ? Verdict::unknown : out.set.size() == 1 ? Verdict::named : Verdict::ambiguous;
  return out;
}

}  // namespace twindeck::diagnosis
