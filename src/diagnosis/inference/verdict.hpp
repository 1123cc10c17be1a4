#pragma once

#include <limits>
#include <string>

namespace twindeck::diagnosis {

enum class Verdict { none, named, ambiguous, unknown };
/// The verdict as a word, as in diagnosis.json.
[[nodiscard]] std::string name_of(Verdict verdict);

/// Input of the rules. The first three members are ln weights in nats: ln evidence plus ln prior.
struct Weighed {
  double none = 0.0;                                                 ///< of the hypothesis without a cause
  double something_else = -std::numeric_limits<double>::infinity();  ///< of the best contrast; -infinity without a contrast
  double leader = -std::numeric_limits<double>::infinity();          ///< of the best entry
  double chi_squared_ratio = 1.0;                                    ///< chi²/dof of the leader at its best scales
  double none_chi_squared_ratio = 1.0;                               ///< the same without a cause
  bool in_all_conditions = true;                                     ///< the leader acts in every condition alike
  double kappa = 0.0, effect = 0.0;  ///< RMS relative changes of frequencies: left over by the leader, and caused by it
  double size_error = 0.0;           ///< [-] relative error of the leader's effect
  bool between_states = false;       ///< the leader acts in one state only
  bool tuned = false;                ///< the leader has a frequency of its own (an oscillator) and adds a mode
  int members = 1;                   ///< number of entries in the set that is not told apart, leader included
};

struct Ruling {
  Verdict verdict = Verdict::none;
  /// ln odds of the leader divided by its chi²/dof (1 at least): against none, and against the better of none and "something
  /// else changed".
  double against_none = 0.0, against_both = 0.0;
  double threshold = 0.0;
  bool something_else_in_set = false;
  std::string reason;  ///< one clause for people
};

/// Thresholds in nats. A cause that acts in all conditions looks like a form error, and form errors differ between structures.
/// `in_all` comes from 68 sound structures of another class than the model (seeds 66001 to 66275). Two of them reached more
/// than 11 nats: 23 and 31. The other thresholds come from seeds 69001 to 69400 and 70001 to 70400, which contain 120 causes
/// that the catalogue lacks.
struct RuleOptions {
  double in_some = 3.0, in_all = 32.0;  ///< least lead over none of a cause that acts in some conditions, in all conditions
  double set_within = 3.0;              ///< entries within this distance of the leader are not told apart from it
  /// "Something else changed" belongs to the set if the lead of the leader over it is smaller than this. In 29 trials the truth
  /// was an axial force or a rotational restraint, which the catalogue lacks. 13 of them got an answer, 11 of these with a lead
  /// below 18. Of 231 right answers, 17 have a lead below 25.
  double else_within = 25.0;
  double most_leftover = 0.4;  ///< [-] largest kappa / effect: four times the expected value
  /// Between states, the leftover is not tested if the lead over "something else changed" is at least this. `effect` is an
  /// effect on frequencies, but a mass or a moved support may change mainly the shapes. Of eleven right leaders with a leftover
  /// above `most_leftover`, ten have a lead of 38 and more. Of 13 causes that the catalogue lacks, none has.
  double leftover_counts_within = 35.0;
  /// Largest chi²/dof that the leader may leave. Between states, the size error of the effect may raise this limit.
  double most_misfit = 2.0;
  /// `in_all` and `most_misfit` for a tuned cause. Such a cause adds a mode and has a size besides its frequency, so it can fit
  /// what other causes cannot. Of the tuned causes that act in all conditions, one of nine right ones and three of four false
  /// ones have less than 50 nats. Two coupled oscillators leave a chi²/dof of 1.6, a single one leaves 1.4.
  double in_all_tuned = 45.0, most_misfit_tuned = 1.5;
};

/// The rules of the verdict (decision 0013). They decide in this order: whether there is a cause; if so, which cause; if not,
/// whether something else changed or nothing did.
[[nodiscard]] Ruling rule(const Weighed& weighed, const RuleOptions& options = {});

/// [nats] A name needs a 5 % quantile of the gain above this value. One of 12 wrong answers has less, and one of 264 right
/// answers (0.1).
constexpr double kLeastGain = 1.0;

/// A named cause must predict modes that it was not fitted to. If the 5 % quantile of the gain is at or below kLeastGain, a
/// cause in all conditions is withdrawn (none), and a change is kept without a name (unknown).
[[nodiscard]] Ruling guarded(Ruling ruling, double low_gain, bool in_all_conditions);

}  // namespace twindeck::diagnosis
