#pragma once

#include <limits>
#include <string>

namespace twindeck::diagnosis {

enum class Verdict { none, named, ambiguous, unknown };
/// "none" and so on, as in diagnosis.json.
[[nodiscard]] std::string name_of(Verdict verdict);

/// What the rules look at. ln weights: evidence and prior together, in nats.
struct Weighed {
  double none = 0.0;
  double something_else = -std::numeric_limits<double>::infinity();  ///< the best contrast's; -infinity without one
  double leader = -std::numeric_limits<double>::infinity();          ///< the best entry's
  double chi_squared_ratio = 1.0;                                    ///< chi²/dof of the leader at its best scales
  double none_chi_squared_ratio = 1.0;                               ///< the same without a cause
  bool in_all_conditions = true;                                     ///< the leader acts in every condition alike
  double kappa = 0.0, effect = 0.0;  ///< leftover beside the leader, RMS effect of the leader on frequencies
  int members = 1;                   ///< of the set that is not told apart, the leader among them
};

struct Ruling {
  Verdict verdict = Verdict::none;
  double against_none = 0.0, against_both = 0.0;  ///< D/B and Do/B: leader against none; against none and something else
  double threshold = 0.0;
  bool something_else_in_set = false;
  std::string reason;  ///< one clause for people
};

/// Thresholds in nats. What acts in all conditions looks like form error, which differs from structure to structure in ways
/// that no model of it has; a bench of sound structures of another class reached 6.5 nats there and 1.8 with two states.
struct RuleOptions {
  double in_some = 3.0, in_all = 7.0;
  double set_within = 3.0;   ///< of the leader: not told apart from it
  double most_misfit = 2.0;  ///< chi²/dof beyond which something is left unexplained
};

/// The rules of the verdict (decision 0013): first that a cause is there, then which, then whether something else changed, then
/// none.
[[nodiscard]] Ruling rule(const Weighed& weighed, const RuleOptions& options = {});

/// A name has to predict modes that it was not fitted to: with a 5 % quantile of the gain at or below zero a cause in all
/// conditions is taken back (none), a change is kept without a name (unknown).
[[nodiscard]] Ruling guarded(Ruling ruling, double low_gain, bool in_all_conditions);

}  // namespace twindeck::diagnosis
