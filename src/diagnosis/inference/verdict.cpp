#include "diagnosis/inference/verdict.hpp"

#include <algorithm>

namespace twindeck::diagnosis {

std::string name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::named:
      return "named";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::unknown:
      return "unknown";
    case Verdict::none:
      break;
  }
  return "none";
}

namespace {

/// chi²/dof that may be left beside the leader.
double most_misfit(const Weighed& w, const RuleOptions& options) {
  if (w.tuned) return options.most_misfit_tuned;
  // An effect that is known to a part of itself leaves the square of that part of the chi² that it explains.
  const double by_size_error = w.between_states ? 1.0 + w.size_error * w.size_error * (w.none_chi_squared_ratio - 1.0) : 0.0;
  return std::max(options.most_misfit, by_size_error);
}

bool leaves_too_much_over(const Weighed& w, double ahead_of_something_else, const RuleOptions& options) {
  const bool counts = !w.between_states || ahead_of_something_else < options.leftover_counts_within;
  return counts && w.kappa > options.most_leftover * w.effect;
}

}  // namespace

Ruling rule(const Weighed& w, const RuleOptions& options) {
  const double misfit = std::max(1.0, w.chi_squared_ratio);
  Ruling out;
  out.against_none = (w.leader - w.none) / misfit;
  out.against_both = (w.leader - std::max(w.none, w.something_else)) / misfit;
  const double ahead_of_something_else = (w.leader - w.something_else) / misfit;
  const double in_all = w.tuned ? options.in_all_tuned : options.in_all;
  out.threshold = w.in_all_conditions ? in_all : options.in_some;
  if (out.against_none > out.threshold) {
    out.verdict = Verdict::unknown;
    if (misfit > most_misfit(w, options)) {
      out.reason = "the best cause leaves too much unexplained";
    } else if (out.against_both < -options.set_within) {
      out.reason = "something else changed explains more than the best cause";
    } else if (leaves_too_much_over(w, ahead_of_something_else, options)) {
      out.reason = "the nearest cause leaves too much of the change unexplained";
    } else {
      out.something_else_in_set =
          !w.in_all_conditions && w.something_else > w.none && ahead_of_something_else < options.else_within;
      const bool alone = w.members == 1 && !out.something_else_in_set && out.against_both > options.set_within;
      out.verdict = alone ? Verdict::named : Verdict::ambiguous;
      out.reason = alone ? "one cause is left" : "these data do not tell the causes of the set apart";
    }
    return out;
  }
  if (w.something_else - w.none > options.in_some) {
    out.verdict = Verdict::unknown;
    out.reason = "something changed that no cause of the catalogue explains";
  } else if (w.none_chi_squared_ratio > options.most_misfit) {
    out.verdict = Verdict::unknown;
    out.reason = "the rows are further off than any form error explains";
  } else {
    out.reason = "nothing stands out of the form error";
  }
  return out;
}

Ruling guarded(Ruling ruling, double low_gain, bool in_all_conditions) {
  if (ruling.verdict != Verdict::named && ruling.verdict != Verdict::ambiguous) return ruling;
  if (low_gain > kLeastGain) return ruling;
  ruling.verdict = in_all_conditions ? Verdict::none : Verdict::unknown;
  ruling.something_else_in_set = false;
  ruling.reason = "the best cause does not predict modes that it was not fitted to";
  return ruling;
}

}  // namespace twindeck::diagnosis
